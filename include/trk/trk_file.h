/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* Camera parameters in files: one set for every video field (document, section 7.5). */
#ifndef TRK_FILE_H
#define TRK_FILE_H

#include "trk_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Buffer size for a time code "HH:MM:SS:FF:D" with its NUL. */
enum { trkTimeCodeSize = 16 };

/* Opens a file and returns its time code (in a buffer of trkTimeCodeSize) and its constants. trkFailed when it cannot
 * be read, trkInvalidVersion when its first lines are malformed. Each later call reads one line. */
TRK_PUBLIC trkError trkFileOpenRead(const char* fileName, char* timeCode, trkCameraConstants* constants,
                                    trkHandle* handle);

#ifndef ONLY_READ

/* Creates a file with a time code "HH:MM:SS:FF:D" and constants. It replaces an existing file. Until it is closed, the
 * file is named `fileName`.part. trkFailed also for a text that is not a time code. */
TRK_PUBLIC trkError trkFileOpenWrite(const char* fileName, const char* timeCode, const trkCameraConstants* constants,
                                     trkHandle* handle);

#endif

/* Gives a written file its final name; trkFailed when this fails. Open files are also closed at exit. */
TRK_PUBLIC trkError trkFileClose(trkHandle handle);

/* The next set. trkUnavailable after the last one, also when the line after it is truncated. trkInvalidVersion for a
 * malformed line: the next call continues with the next line. */
TRK_PUBLIC trkError trkFileReadParams(trkHandle handle, trkCameraParams* params);

#ifndef ONLY_READ

/* trkFailed when the format has unknown options or both trkVertical and trkDiagonal, when a number is not finite, or
 * when the file cannot be written. */
TRK_PUBLIC trkError trkFileWriteParams(trkHandle handle, const trkCameraParams* params);

#endif

#ifdef __cplusplus
}
#endif

#endif
