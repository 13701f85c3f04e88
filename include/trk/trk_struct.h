/* Camera parameters and constants, format options, errors, and their text (document, sections 3, 5 and 7).
 *
 * These headers are for libtrk: structures as in the document. Those of the same names in trk_identified are for
 * libtrk_identified: a camera number comes first in the structures, and there are some more functions. A program picks
 * one by its include path and its library; it cannot mix them.
 *
 * The interface works from C89 and C++98. Every function may be called from any thread; calls on one handle take turns.
 * A null pointer gives trkFailed, a handle that is not open, or is of another kind or direction, trkInvalidHandle.
 * With ONLY_READ defined the functions that write are not declared. */
#ifndef TRK_STRUCT_H
#define TRK_STRUCT_H

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
#ifdef TRK_IDENTIFIED
  unsigned id; /* of the camera; 0: none */
#endif
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
#ifdef TRK_IDENTIFIED
  unsigned id; /* of the camera; 0: none */
#endif
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
enum { trkStringSize = 4096 };

/* The text of a record as it stands in files and ASCII datagrams; numbers are the shortest that read back to the same
 * value, with a decimal point whatever the locale. Gives its length; 0, and an empty text, for a number that is not
 * finite and for a null pointer. The buffer has trkStringSize bytes. */
TRK_PUBLIC int trkParamsToString(const trkCameraParams* params, char* buffer);
/* The same of constants. */
TRK_PUBLIC int trkConstantsToString(const trkCameraConstants* constants, char* buffer);

/* The record of a text: 1 when it was understood, else 0, and the record is left as it was. */
TRK_PUBLIC int trkStringToParams(const char* string, trkCameraParams* params);
/* The same of constants. */
TRK_PUBLIC int trkStringToConstants(const char* string, trkCameraConstants* constants);

/* The identifiers of a format mask that matter for it, with single spaces between; bits without a name are left out.
 * Gives the length of the text. The buffer has trkStringSize bytes. */
TRK_PUBLIC int trkFormatToString(unsigned format, char* buffer);

/* The mask that identifiers name, in any case and order, separated by white space; none is 0. Of two opposite ones the
 * last counts. 1 when all were understood, else 0, and the mask is left as it was. */
TRK_PUBLIC int trkStringToFormat(const char* string, unsigned* format);

#ifdef __cplusplus
}
#endif

#endif
