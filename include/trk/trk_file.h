/* Camera parameters in files: one set for every video field (document, section 7.5). */
#ifndef TRK_FILE_H
#define TRK_FILE_H

#include "trk_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Room for a time code "HH:MM:SS:FF:D" and its NUL. */
enum { trkTimeCodeSize = 16 };

/* Opens a file and gives its time code (a buffer of trkTimeCodeSize) and constants. trkFailed when it cannot be read,
 * trkInvalidVersion when its beginning is not sound. Lines are read as they are asked for. */
TRK_PUBLIC trkError trkFileOpenRead(const char* fileName, char* timeCode, trkCameraConstants* constants,
                                    trkHandle* handle);

#ifndef ONLY_READ

/* Creates a file with a time code "HH:MM:SS:FF:D" and constants, in the place of one of that name. The file stands
 * under `fileName` once it is closed, until then under `fileName`.part. trkFailed also for a text that is no time code.
 */
TRK_PUBLIC trkError trkFileOpenWrite(const char* fileName, const char* timeCode, const trkCameraConstants* constants,
                                     trkHandle* handle);

#endif

/* trkFailed when what was written could not be brought to its place. Also done at exit. */
TRK_PUBLIC trkError trkFileClose(trkHandle handle);

/* The next set; trkUnavailable after the last, also where the file was cut in the line behind it. trkInvalidVersion
 * once for a line that is not sound: the next call goes on behind it. */
TRK_PUBLIC trkError trkFileReadParams(trkHandle handle, trkCameraParams* params);

#ifndef ONLY_READ

/* trkFailed when the format has unknown options or both trkVertical and trkDiagonal, a number is not finite, or the
 * file cannot take it. */
TRK_PUBLIC trkError trkFileWriteParams(trkHandle handle, const trkCameraParams* params);

#endif

#ifdef __cplusplus
}
#endif

#endif
