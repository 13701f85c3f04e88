/* Camera parameters and constants, format options, errors, and their text (document, sections 3, 5 and 7).
 *
 * The interface works from C99 and C++. Every function may be called from any thread; calls on one handle take turns. A
 * null pointer gives trkFailed, a handle that is not open, or is of another kind or direction, trkInvalidHandle.
 * With ONLY_READ defined the functions that write are not declared. */
#ifndef TRK_STRUCT_H
#define TRK_STRUCT_H

#include <stddef.h>

#if defined(__GNUC__)
#define TRK_PUBLIC __attribute__((visibility("default")))
#else
#define TRK_PUBLIC
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Constants of the camera: pixels and millimetres. */
typedef struct {
  int imageWidth, imageHeight;
  int blankLeft, blankRight, blankTop, blankBottom;
  double chipWidth, chipHeight, fakeChipWidth, fakeChipHeight;
} trkCameraConstants;

/* Position and orientation in metres and degrees: `e` with trkEuler, else `m`, where m[j][i] is row i, column j. */
typedef union {
  double m[4][4];
  struct {
    double x, y, z, pan, tilt, roll;
  } e;
} trkTransform;

/* One set of camera parameters, in the format that `format` says. */
typedef struct {
  unsigned format;
  trkTransform t;
  double fov;              /* image distance in mm, or an angle in degrees */
  double centerX, centerY; /* mm on the chip, or pixels */
  double k1, k2;           /* mm^-2, mm^-4 */
  double focdist;          /* m */
  double aperture;
  unsigned long counter; /* one more with every set */
} trkCameraParams;

/* Format options, to be ORed; each pair names its default first. */
enum {
  trkMatrix = 0x000,
  trkEuler = 0x001,
  trkCameraToStudio = 0x000,
  trkStudioToCamera = 0x002,
  trkCameraZ_Up = 0x000,
  trkCameraY_Up = 0x004,
  trkStudioZ_Up = 0x000,
  trkStudioY_Up = 0x008,
  trkImageDistance = 0x000,
  trkFieldOfView = 0x010,
  trkHorizontal = 0x000,
  trkVertical = 0x020,
  trkDiagonal = 0x040,
  trkConsiderBlank = 0x000,
  trkIgnoreBlank = 0x080,
  trkAdjustAspect = 0x000,
  trkKeepAspect = 0x100,
  trkShiftOnChip = 0x000,
  trkShiftInPixels = 0x200
};

/* What a function gives (document, section 7.2). */
typedef enum {
  trkOK,             /* done */
  trkFailed,         /* not done; an open transfer should be ended */
  trkInvalidHandle,  /* the handle is not, or no longer, one of an open transfer of this kind */
  trkInvalidVersion, /* data of an unknown or unsound format was met; the data before and after it is good */
  trkUnavailable     /* nothing new yet; of a file: its end */
} trkError;

/* What an open...() function gives and a ...Close() function ends. Values are never used twice in a process. */
typedef void* trkHandle;

/* A text that describes the error, never null. It is constant. */
TRK_PUBLIC const char* trkErrorMessage(trkError error);

/* Room that is enough for any text of the functions below, its NUL included. */
enum { trkStringSize = 1024 };

/* The text of a record as it stands in files and ASCII datagrams; numbers are the shortest that read back to the same
 * value, with a decimal point whatever the locale. `size` is the buffer's; a text that does not fit gives trkFailed and
 * an empty string, as does a number that is not finite. */
TRK_PUBLIC trkError trkParamsToString(const trkCameraParams* params, char* buffer, size_t size);
/* The same of constants. */
TRK_PUBLIC trkError trkConstantsToString(const trkCameraConstants* constants, char* buffer, size_t size);

/* The record of a text: trkInvalidVersion, and the record left as it was, when the text is not sound. A leading camera
 * number "I<n>" is read over. */
TRK_PUBLIC trkError trkStringToParams(const char* string, trkCameraParams* params);
/* The same of constants. */
TRK_PUBLIC trkError trkStringToConstants(const char* string, trkCameraConstants* constants);

/* The identifiers of a format mask that matter for it, with single spaces between; bits without a name are left out. */
TRK_PUBLIC trkError trkFormatToString(unsigned format, char* buffer, size_t size);

/* The mask that identifiers name, in any case and order, separated by white space; none is 0. Of two opposite ones the
 * last counts. trkFailed, and the mask left as it was, for an unknown word. */
TRK_PUBLIC trkError trkStringToFormat(const char* string, unsigned* format);

#ifdef __cplusplus
}
#endif

#endif
