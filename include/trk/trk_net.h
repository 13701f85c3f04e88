/* Camera parameters through the network: UDP datagrams (document, section 7.4). */
#ifndef TRK_NET_H
#define TRK_NET_H

#include "trk_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Receives on a UDP port (1 to 65535) of every interface, ASCII and binary of every known sender. */
#ifdef TRK_IDENTIFIED
/* With `skipOld` 0 trkNetReadParams gives queued parameters oldest first, else the newest only. */
TRK_PUBLIC trkError trkNetOpenRead(int localPort, trkHandle* handle, int skipOld);
#else
TRK_PUBLIC trkError trkNetOpenRead(int localPort, trkHandle* handle);
#endif

#ifndef ONLY_READ

/* Sends to a port of a host, given by name or address. With `binary` not 0 as memory images of the structures with a
 * camera number, which only receivers that know this machine's layout understand, else as text, which all do. Of the
 * environment, TRK_LAYOUT names another layout (as in trk_mem.h), and MULTICAST_TTL the TTL of multicast datagrams (0
 * to 255). Constants are sent again about once a second together with parameters, so that receivers which come later
 * learn them. */
TRK_PUBLIC trkError trkNetOpenWrite(const char* remoteHost, int remotePort, int binary, trkHandle* handle);

#endif

/* Frees the port. Ends the handle in any case. */
TRK_PUBLIC trkError trkNetClose(trkHandle handle);

/* The newest parameters that arrived since the last call; of a handle with skipOld 0 the oldest of up to 16 that are
 * queued. Does not wait. A datagram that is not sound costs itself
 * alone: trkInvalidVersion is given once, by a call that has nothing good to give. */
TRK_PUBLIC trkError trkNetReadParams(trkHandle handle, trkCameraParams* params);

/* Parameters whose counter is `numPassed` past that of the last ones, from those that have arrived (up to 16 are kept,
 * each counter once, in the order of their counters). When they have not: the next ones after. The newest instead when
 * none were given before, the newest counter is more than `numTolerated` past the wanted one, all counters are below
 * the wanted one, counting restarted, or all 16 places are full. Both numbers must not be negative. Does not wait.
 * Gives trkInvalidVersion as trkNetReadParams does. */
TRK_PUBLIC trkError trkNetBufReadParams(trkHandle handle, trkCameraParams* params, int numPassed, int numTolerated);

/* The last constants that arrived since the last call. Does not wait. May give the one trkInvalidVersion of a
 * datagram that is not sound in the place of trkNetReadParams. */
TRK_PUBLIC trkError trkNetReadConstants(trkHandle handle, trkCameraConstants* constants);

#ifdef TRK_IDENTIFIED

/* The last constants that arrived, also when they were given before; trkUnavailable before the first. */
TRK_PUBLIC trkError trkNetReadConstants2(trkHandle handle, trkCameraConstants* constants);

/* How many parameters are queued for trkNetReadParams and trkNetBufReadParams; 0 for a handle that cannot be read. */
TRK_PUBLIC int trkNetParamsAvailable(trkHandle handle);

/* As `skipOld` of trkNetOpenRead, from now on. */
TRK_PUBLIC void trkNetSkipOld(int skip, trkHandle handle);

#endif

#ifndef ONLY_READ

/* trkFailed when the format has unknown options or both trkVertical and trkDiagonal, a number is not finite, or the
 * system does not send. */
TRK_PUBLIC trkError trkNetWriteParams(trkHandle handle, const trkCameraParams* params);
/* Sent at once, and remembered for repeating. Fails as trkNetWriteParams does. */
TRK_PUBLIC trkError trkNetWriteConstants(trkHandle handle, const trkCameraConstants* constants);

#endif

#ifdef __cplusplus
}
#endif

#endif
