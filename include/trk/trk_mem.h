/* Camera parameters through shared memory (document, section 7.3). */
#ifndef TRK_MEM_H
#define TRK_MEM_H

#include "trk_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Flags of trkMemConfigure. One kind of memory, ORed with trkMemRecreate or not. */
enum {
  trkMemDefault = 0x0,  /* the system's default kind */
  trkMemSysV = 0x1,     /* System V shared memory */
  trkMemArena = 0x2,    /* a shared arena on IRIX; the default kind on every other system */
  trkMemRecreate = 0x10 /* a handle left alone with its memory goes on in a fresh one with the same contents */
};

/* Options of all following calls of trkMemOpen. Unknown flags are ignored. */
TRK_PUBLIC void trkMemConfigure(unsigned flags);

/* Makes the shared memory of a slot (0 to 61) or attaches to it. trkInvalidVersion when the memory there is not trk's:
 * it is left as it is. New memory has the identified records of 64-bit programs, which every program in use can attach
 * to; TRK_LAYOUT in the environment says otherwise: document or identified, with _lp64 or _i386 behind it. trkFailed
 * for other words there. Memory that is there is read and written in its own layout. Waits up to 0.2 s for another
 * program that is making it. */
TRK_PUBLIC trkError trkMemOpen(int slot, trkHandle* handle);

/* Detaches; the last one to do so, dead processes not counted, removes the memory. */
TRK_PUBLIC trkError trkMemClose(trkHandle handle);

/* Closes all handles of trkMemOpen; also done at exit. Any number of times. */
TRK_PUBLIC void trkMemCloseAll(void);

/* The newest parameters written since the handle was opened and not read with it yet, at once. Memory that was removed
 * and created again is attached to. trkInvalidVersion once for a set that is not sound. A handle that has written
 * nothing lets go of memory that nobody else has attached to for a second, so that a program of any generation can make
 * its own. */
TRK_PUBLIC trkError trkMemReadParams(trkHandle handle, trkCameraParams* params);

/* The constants in the memory if they are new to this handle, those written before it was opened included. */
TRK_PUBLIC trkError trkMemReadConstants(trkHandle handle, trkCameraConstants* constants);

#ifndef ONLY_READ

/* trkFailed when the format has unknown options or both trkVertical and trkDiagonal, a number is not finite, the
 * memory's layout cannot hold the counter (32-bit programs'), or there is no permission. */
TRK_PUBLIC trkError trkMemWriteParams(trkHandle handle, const trkCameraParams* params);
/* Whoever opens the slot later finds them. Fails as trkMemWriteParams does. */
TRK_PUBLIC trkError trkMemWriteConstants(trkHandle handle, const trkCameraConstants* constants);

#endif

#ifdef __cplusplus
}
#endif

#endif
