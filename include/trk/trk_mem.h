/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* Camera parameters through shared memory (document, section 7.3). */
#ifndef TRK_MEM_H
#define TRK_MEM_H

#include "trk_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Flags of trkMemConfigure: one kind of memory, optionally ORed with trkMemRecreate. */
enum {
  trkMemDefault = 0x0,  /* the system's default kind */
  trkMemSysV = 0x1,     /* System V shared memory */
  trkMemArena = 0x2,    /* a shared arena on IRIX; the default kind on every other system */
  trkMemRecreate = 0x10 /* when all others have detached, the memory is recreated with the same contents */
};

/* Options of all following calls of trkMemOpen. Unknown flags are ignored. */
TRK_PUBLIC void trkMemConfigure(unsigned flags);

/* Attaches to the shared memory of a slot (0 to 61), or creates it. trkInvalidVersion when the existing memory is not
 * trk's; it is not changed. New memory has the identified records of 64-bit programs, to which every program in use can
 * attach. The environment variable TRK_LAYOUT selects another layout: document or identified, optionally followed by
 * _lp64 or _i386; trkFailed for other values. Existing memory is read and written in its own layout. Waits up to 0.2 s
 * for another program that is creating it. */
TRK_PUBLIC trkError trkMemOpen(int slot, trkHandle* handle);

/* Detaches. The last one to detach removes the memory; dead processes are not counted. */
TRK_PUBLIC trkError trkMemClose(trkHandle handle);

/* Closes all handles of trkMemOpen; also done at exit. May be called any number of times. */
TRK_PUBLIC void trkMemCloseAll(void);

/* The newest parameters written since the handle was opened and not yet read with it. Does not wait. Reattaches to
 * memory that was removed and recreated. trkInvalidVersion once for a malformed set. A handle that has written nothing
 * detaches when no other program was attached for a second, so that a program of any generation can create its own
 * memory. */
TRK_PUBLIC trkError trkMemReadParams(trkHandle handle, trkCameraParams* params);

/* The constants in the memory if this handle has not read them yet, including those written before it was opened. */
TRK_PUBLIC trkError trkMemReadConstants(trkHandle handle, trkCameraConstants* constants);

#ifndef ONLY_READ

/* trkFailed when the format has unknown options or both trkVertical and trkDiagonal, when a number is not finite, when
 * the layout of the memory cannot hold the counter (that of 32-bit programs), or without write permission. */
TRK_PUBLIC trkError trkMemWriteParams(trkHandle handle, const trkCameraParams* params);
/* Programs that open the slot later can read them. Fails as trkMemWriteParams does. */
TRK_PUBLIC trkError trkMemWriteConstants(trkHandle handle, const trkCameraConstants* constants);

#endif

#ifdef __cplusplus
}
#endif

#endif
