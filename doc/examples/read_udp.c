/* Prints the camera that a tracker sends to a UDP port: read_udp PORT SETS. Ends after SETS sets of parameters. */
#define _POSIX_C_SOURCE 199309L
#include <trk/trk_net.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* The functions do not wait; a renderer would call them once a field instead. */
static void wait_a_little(void) {
  const struct timespec millisecond = {0, 1000000};
  nanosleep(&millisecond, NULL);
}

static void print_constants(const trkCameraConstants* c) {
  printf("constants: image %d x %d pixels, chip %g x %g mm\n", c->imageWidth, c->imageHeight, c->chipWidth,
         c->chipHeight);
}

static void print_params(const trkCameraParams* p) {
  char words[trkStringSize];
  if (trkFormatToString(p->format, words, sizeof words) != trkOK) words[0] = '\0';
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
  trkHandle handle;
  trkCameraParams params;
  trkCameraConstants constants;
  long wanted, sets = 0;
  if (argc != 3 || (wanted = strtol(argv[2], NULL, 10)) <= 0) {
    fprintf(stderr, "usage: read_udp PORT SETS\n");
    return 2;
  }
  trkError error = trkNetOpenRead(atoi(argv[1]), &handle);
  if (error != trkOK) {
    fprintf(stderr, "port %s: %s\n", argv[1], trkErrorMessage(error));
    return 1;
  }
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  while (sets < wanted && error != trkFailed) {
    const trkError constants_error = trkNetReadConstants(handle, &constants);
    if (constants_error == trkOK) print_constants(&constants);
    error = trkNetReadParams(handle, &params);
    if (error == trkOK) {
      print_params(&params);
      ++sets;
    } else if (error == trkUnavailable) {
      wait_a_little();
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
