/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* A renderer: asks once a video field for the camera that a tracker sends to a UDP port, and prints it: renderer PORT
 * FIELDS. Ends after FIELDS fields with a camera. */
#define _POSIX_C_SOURCE 199309L
#include "trk_net.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Stands in for what waits for the next field; gives how many have passed. */
static int wait_for_a_field(void) {
  const struct timespec field = {0, 20000000};
  nanosleep(&field, NULL);
  return 1;
}

static void print_constants(const trkCameraConstants* c) {
  printf("constants: image %d x %d pixels, chip %g x %g mm\n", c->imageWidth, c->imageHeight, c->chipWidth,
         c->chipHeight);
}

static void print_params(const trkCameraParams* p) {
  char words[trkStringSize];
  trkFormatToString(p->format, words);
  if (p->format & trkEuler) {
    printf("%lu: at (%g, %g, %g) m, pan %g tilt %g roll %g degrees [%s]\n", p->counter, p->t.e.x, p->t.e.y, p->t.e.z,
           p->t.e.pan, p->t.e.tilt, p->t.e.roll, words);
  } else {
    /* Column 3 is the position: the camera's, or with trkStudioToCamera the studio's in the camera. */
    printf("%lu: matrix with translation (%g, %g, %g) m [%s]\n", p->counter, p->t.m[3][0], p->t.m[3][1], p->t.m[3][2],
           words);
  }
}

int main(int argc, char** argv) {
  /* Sets that may be in store: more is more delay, less is more jitter. */
  const int tolerated = 2;
  trkHandle handle;
  trkCameraParams params;
  trkCameraConstants constants;
  trkError error, constants_error;
  long wanted, fields = 0;
  if (argc != 3 || (wanted = strtol(argv[2], NULL, 10)) <= 0) {
    fprintf(stderr, "usage: renderer PORT FIELDS\n");
    return 2;
  }
  error = trkNetOpenRead(atoi(argv[1]), &handle);
  if (error != trkOK) {
    fprintf(stderr, "port %s: %s\n", argv[1], trkErrorMessage(error));
    return 1;
  }
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  while (fields < wanted && error != trkFailed) {
    const int passed = wait_for_a_field();
    constants_error = trkNetReadConstants(handle, &constants);
    if (constants_error == trkOK) print_constants(&constants);
    /* Where the wanted set has not come, a renderer draws with the last one again. */
    error = trkNetBufReadParams(handle, &params, passed, tolerated);
    if (error == trkOK) {
      print_params(&params);
      ++fields;
    }
    /* Reported once, by whichever call comes first. */
    if (constants_error == trkInvalidVersion || error == trkInvalidVersion) {
      fprintf(stderr, "something that is not trk has arrived\n");
    }
  }
  trkNetClose(handle);
  if (error == trkFailed) fprintf(stderr, "port %s: %s\n", argv[1], trkErrorMessage(error));
  return error == trkFailed ? 1 : 0;
}
