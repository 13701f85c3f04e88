/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
#include "trk_net.h"

int main(void) {
  trkCameraParams params;
  return trkNetReadParams(0, &params) == trkInvalidHandle ? 0 : 1;
}
