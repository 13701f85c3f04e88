/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* Camera parameters through the network: UDP datagrams (document, section 7.4). */
#ifndef TRK_NET_H
#define TRK_NET_H

#include "trk_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Receives on a UDP port (1 to 65535) of every interface: ASCII and binary datagrams of every known sender. */
#ifdef TRK_IDENTIFIED
/* With `skipOld` 0, trkNetReadParams returns queued parameters, oldest first; else only the newest. */
TRK_PUBLIC trkError trkNetOpenRead(int localPort, trkHandle* handle, int skipOld);
#else
TRK_PUBLIC trkError trkNetOpenRead(int localPort, trkHandle* handle);
#endif

#ifndef ONLY_READ

/* Sends to a port of a host, given by name or address. With `binary` 0 it sends text, which all receivers understand;
 * else memory images of the structures with a camera number, which only receivers that know the layout of this machine
 * understand. Environment variables: TRK_LAYOUT selects another layout (as in trk_mem.h), MULTICAST_TTL the TTL of
 * multicast datagrams (0 to 255). Constants are sent again about once a second, together with parameters, for receivers
 * that start later. */
TRK_PUBLIC trkError trkNetOpenWrite(const char* remoteHost, int remotePort, int binary, trkHandle* handle);

#endif

/* Frees the port. The handle is invalid afterwards, even after an error. */
TRK_PUBLIC trkError trkNetClose(trkHandle handle);

/* The newest parameters that arrived since the last call; with skipOld 0, the oldest of up to 16 that are queued. Does
 * not wait. A malformed datagram does not affect others: trkInvalidVersion is returned once, by a call that has nothing
 * valid to return. */
TRK_PUBLIC trkError trkNetReadParams(trkHandle handle, trkCameraParams* params);

/* Of the parameters that have arrived: those whose counter is `numPassed` more than that of the last ones returned, or
 * else the ones with the next higher counter. Up to 16 are queued, each counter once, in the order of their counters.
 * The newest are returned instead when none were returned before, when the newest counter is more than `numTolerated`
 * past the wanted one, when all counters are below the wanted one, when the counter restarted, or when the queue is
 * full. Neither number may be negative. Does not wait. Returns trkInvalidVersion as trkNetReadParams does. */
TRK_PUBLIC trkError trkNetBufReadParams(trkHandle handle, trkCameraParams* params, int numPassed, int numTolerated);

/* The last constants that arrived since the last call. Does not wait. The single trkInvalidVersion for a malformed
 * datagram may be returned here and not by trkNetReadParams. */
TRK_PUBLIC trkError trkNetReadConstants(trkHandle handle, trkCameraConstants* constants);

#ifdef TRK_IDENTIFIED

/* The last constants that arrived, even if they were returned before; trkUnavailable before the first. */
TRK_PUBLIC trkError trkNetReadConstants2(trkHandle handle, trkCameraConstants* constants);

/* How many parameters are queued for trkNetReadParams and trkNetBufReadParams; 0 for a handle that cannot be read. */
TRK_PUBLIC int trkNetParamsAvailable(trkHandle handle);

/* Sets `skipOld` of trkNetOpenRead for the following calls. */
TRK_PUBLIC void trkNetSkipOld(int skip, trkHandle handle);

#endif

#ifndef ONLY_READ

/* trkFailed when the format has unknown options or both trkVertical and trkDiagonal, when a number is not finite, or
 * when the system cannot send. */
TRK_PUBLIC trkError trkNetWriteParams(trkHandle handle, const trkCameraParams* params);
/* Sent at once, and stored to be repeated. Fails as trkNetWriteParams does. */
TRK_PUBLIC trkError trkNetWriteConstants(trkHandle handle, const trkCameraConstants* constants);

#endif

#ifdef __cplusplus
}
#endif

#endif
