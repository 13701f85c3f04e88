/* For libtrk_identified: trk/trk_struct.h with a camera number in the structures. */
#ifndef TRK_IDENTIFIED
#define TRK_IDENTIFIED 1
#endif
#include "../trk/trk_struct.h"
