/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* For libtrk_identified: trk/trk_net.h with a camera number in the structures. */
#ifndef TRK_IDENTIFIED
#define TRK_IDENTIFIED 1
#endif
#include "../trk/trk_net.h"
