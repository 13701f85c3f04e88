/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* Camera parameters and constants, format options, errors, and their text forms (document, sections 3, 5 and 7).
 *
 * These headers are for libtrk: structures as in the document. The headers of the same names in trk_identified are for
 * libtrk_identified: the structures begin with a camera number, and there are some more functions. A program selects
 * one set by its include path and its library; it cannot mix them.
 *
 * The interface works with C89 and C++98. Every function may be called from any thread; calls on one handle are
 * serialised. A null pointer returns trkFailed. A handle that is not open, or is of another kind or direction, returns
 * trkInvalidHandle. If ONLY_READ is defined, the functions that write are not declared. */
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

/* One set of camera parameters, in the format given by `format`. */
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
  unsigned long counter; /* increases by one with every set */
} trkCameraParams;

/* Format options, to be ORed. The first of each group is the default. */
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

/* Return values of the functions (document, section 7.2). */
typedef enum {
  trkOK,             /* done */
  trkFailed,         /* not done; an open transfer should be ended */
  trkInvalidHandle,  /* the handle does not belong to an open transfer of this kind */
  trkInvalidVersion, /* some data was malformed or of an unknown format; the data before and after it is good */
  trkUnavailable     /* nothing new yet; for a file: its end */
} trkError;

/* Returned by an ...Open...() function, ended by a ...Close() function. Values are never used twice in a process. */
typedef void* trkHandle;

/* A constant text that describes the error, never null. */
TRK_PUBLIC const char* trkErrorMessage(trkError error);

/* Buffer size that is enough for any text of the functions below, including its NUL. */
enum { trkStringSize = 4096 };

/* The text of a record as in files and ASCII datagrams. Numbers are the shortest that read back to the same value, with
 * a decimal point in every locale. Returns the length; 0 and an empty text for a number that is not finite and for a
 * null pointer. The buffer has trkStringSize bytes. */
TRK_PUBLIC int trkParamsToString(const trkCameraParams* params, char* buffer);
/* The same for constants. */
TRK_PUBLIC int trkConstantsToString(const trkCameraConstants* constants, char* buffer);

/* Reads a record from its text. Returns 1 if the text is valid, else 0; then the record is not changed. */
TRK_PUBLIC int trkStringToParams(const char* string, trkCameraParams* params);
/* The same for constants. */
TRK_PUBLIC int trkStringToConstants(const char* string, trkCameraConstants* constants);

/* The identifiers that are relevant for a format mask, separated by single spaces; bits without a name are omitted.
 * Returns the length of the text. The buffer has trkStringSize bytes. */
TRK_PUBLIC int trkFormatToString(unsigned format, char* buffer);

/* Reads a mask from identifiers in any case and order, separated by white space; no identifier gives 0. Of two opposite
 * ones, the last is used. Returns 1 if all are known, else 0; then the mask is not changed. */
TRK_PUBLIC int trkStringToFormat(const char* string, unsigned* format);

#ifdef __cplusplus
}
#endif

#endif
