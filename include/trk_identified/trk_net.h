/* As trk/trk_net.h, with a camera number in the structures: for libtrk_identified. */
#ifndef TRK_IDENTIFIED
#define TRK_IDENTIFIED 1
#endif
#include "../trk/trk_net.h"
