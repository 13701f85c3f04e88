/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* A crane's controller: sends where its camera is to a renderer, 50 times a second: crane_controller HOST PORT SETS.
 * Ends after SETS sets of parameters. */
#define _POSIX_C_SOURCE 199309L
#include "trk_net.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void wait_for_a_field(void) {
  const struct timespec field = {0, 20000000};
  nanosleep(&field, NULL);
}

/* The camera swings to and fro at the end of the arm. */
static trkCameraParams camera_at(unsigned long counter) {
  const double swing = (double)(counter % 200) / 100.0 - 1.0; /* -1 to 1 */
  trkCameraParams p;
  memset(&p, 0, sizeof p);
  p.format = trkEuler; /* z-up, fov in mm, shift in mm on the chip: every other option at its default */
  p.t.e.x = 2.5 * swing;
  p.t.e.y = -4.0;
  p.t.e.z = 2.0;
  p.t.e.pan = 20.0 * swing;
  p.t.e.tilt = -8.0;
  p.fov = 8.0;
  p.focdist = 4.0;
  p.counter = counter;
  return p;
}

int main(int argc, char** argv) {
  /* Image, blanks, chip and fake chip; without blanks the two chips are the same. */
  const trkCameraConstants constants = {1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39};
  trkHandle handle;
  trkError error;
  unsigned long counter, sets;
  if (argc != 4 || (sets = strtoul(argv[3], NULL, 10)) == 0) {
    fprintf(stderr, "usage: crane_controller HOST PORT SETS\n");
    return 2;
  }
  error = trkNetOpenWrite(argv[1], atoi(argv[2]), 0, &handle);
  if (error == trkOK) {
    /* They are sent again with the parameters, for receivers that come later. */
    error = trkNetWriteConstants(handle, &constants);
    for (counter = 1; counter <= sets && error == trkOK; ++counter) {
      const trkCameraParams params = camera_at(counter);
      error = trkNetWriteParams(handle, &params);
      wait_for_a_field();
    }
    trkNetClose(handle);
  }
  if (error != trkOK) fprintf(stderr, "%s port %s: %s\n", argv[1], argv[2], trkErrorMessage(error));
  return error == trkOK ? 0 : 1;
}
