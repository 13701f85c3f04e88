/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* A tracker of its own: a camera that pans, written to shared memory 50 times a second: write_mem SLOT SETS. Ends after
 * SETS sets of parameters, or with Ctrl-C. */
#define _POSIX_C_SOURCE 199309L
#include "trk_mem.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* A process that is killed cannot close its handles and leaves the memory behind. */
static volatile sig_atomic_t ended = 0;

static void end(int signal_number) {
  (void)signal_number;
  ended = 1;
}

static void wait_for_a_field(void) {
  const struct timespec field = {0, 20000000};
  nanosleep(&field, NULL);
}

static trkCameraParams camera_at(unsigned long counter) {
  trkCameraParams p;
  memset(&p, 0, sizeof p);
  p.format = trkEuler; /* z-up, fov in mm, shift in mm on the chip: every other option at its default */
  p.t.e.z = 1.6;
  p.t.e.pan = 30.0 - 0.1 * (double)(counter % 600);
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
  if (argc != 3 || (sets = strtoul(argv[2], NULL, 10)) == 0) {
    fprintf(stderr, "usage: write_mem SLOT SETS\n");
    return 2;
  }
  signal(SIGINT, end);
  signal(SIGTERM, end);
  error = trkMemOpen(atoi(argv[1]), &handle);
  if (error == trkOK) {
    error = trkMemWriteConstants(handle, &constants);
    for (counter = 1; counter <= sets && error == trkOK && !ended; ++counter) {
      const trkCameraParams params = camera_at(counter);
      error = trkMemWriteParams(handle, &params);
      wait_for_a_field();
    }
    /* The last one to close removes the memory. */
    trkMemClose(handle);
  }
  if (error != trkOK) fprintf(stderr, "slot %s: %s\n", argv[1], trkErrorMessage(error));
  return error == trkOK ? 0 : 1;
}
