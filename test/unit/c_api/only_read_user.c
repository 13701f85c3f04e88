/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* With ONLY_READ the writing functions are not declared, so that a program may use their names for its own. */
#define ONLY_READ
#include "trk_file.h"
#include "trk_mem.h"
#include "trk_net.h"

static int trkMemWriteParams = 1, trkMemWriteConstants = 1, trkNetOpenWrite = 1, trkNetWriteParams = 1,
           trkNetWriteConstants = 1, trkFileOpenWrite = 1, trkFileWriteParams = 1;

int main(void) {
  trkCameraParams p;
  trkCameraConstants c;
  const int own = trkMemWriteParams + trkMemWriteConstants + trkNetOpenWrite + trkNetWriteParams +
                  trkNetWriteConstants + trkFileOpenWrite + trkFileWriteParams;
  const int refused = trkMemReadParams(0, &p) == trkInvalidHandle && trkMemReadConstants(0, &c) == trkInvalidHandle &&
                      trkNetReadParams(0, &p) == trkInvalidHandle && trkFileReadParams(0, &p) == trkInvalidHandle;
  return own == 7 && refused ? 0 : 1;
}
