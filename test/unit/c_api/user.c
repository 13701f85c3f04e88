/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* A user of the whole interface, in what C89, C99 and C++98 have in common: user SLOT PORT FILE. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "trk_file.h"
#include "trk_mem.h"
#include "trk_net.h"

static int check(int good, const char* what) {
  if (!good) fprintf(stderr, "failed: %s\n", what);
  return good ? 0 : 1;
}
#define CHECK(condition) check(condition, #condition)

static trkCameraConstants make_constants(void) {
  trkCameraConstants c;
  memset(&c, 0, sizeof c);
  c.imageWidth = 720;
  c.imageHeight = 576;
  c.blankLeft = c.blankRight = 10;
  c.chipWidth = 6.4;
  c.chipHeight = 4.8;
#ifdef TRK_IDENTIFIED
  c.id = 7;
#endif
  return c;
}

static trkError open_read(int port, trkHandle* handle) {
#ifdef TRK_IDENTIFIED
  return trkNetOpenRead(port, handle, 1);
#else
  return trkNetOpenRead(port, handle);
#endif
}

static trkCameraParams make_params(void) {
  trkCameraParams p;
  memset(&p, 0, sizeof p);
  p.format = trkEuler | trkFieldOfView | trkDiagonal;
  p.t.e.pan = 30.0;
  p.fov = 42.0;
  p.counter = 1234ul;
#ifdef TRK_IDENTIFIED
  p.id = 7;
#endif
  return p;
}

static int use_text(void) {
  int failures = 0;
  char text[trkStringSize];
  unsigned format = 0;
  const trkCameraParams p = make_params();
  trkCameraParams q;
  trkCameraConstants c;
  const trkCameraConstants constants = make_constants();
  failures += CHECK(trkParamsToString(&p, text) == (int)strlen(text));
  failures += CHECK(trkStringToParams(text, &q) && q.counter == 1234ul && q.t.e.pan == 30.0);
  failures += CHECK(trkConstantsToString(&constants, text) == (int)strlen(text));
  failures += CHECK(trkStringToConstants(text, &c) && c.imageHeight == 576);
  failures += CHECK(trkFormatToString(p.format, text) > 0);
  failures += CHECK(trkStringToFormat(text, &format) && format == p.format);
  failures += CHECK(strlen(trkErrorMessage(trkUnavailable)) > 0);
  return failures;
}

static int use_memory(int slot) {
  int failures = 0;
  trkHandle writer = NULL, reader = NULL;
  const trkCameraParams p = make_params();
  const trkCameraConstants constants = make_constants();
  trkCameraParams q;
  trkCameraConstants c;
  trkMemConfigure(trkMemDefault);
  failures += CHECK(trkMemOpen(slot, &writer) == trkOK && trkMemOpen(slot, &reader) == trkOK);
  failures += CHECK(trkMemReadParams(reader, &q) == trkUnavailable);
  failures += CHECK(trkMemWriteConstants(writer, &constants) == trkOK && trkMemWriteParams(writer, &p) == trkOK);
  failures += CHECK(trkMemReadParams(reader, &q) == trkOK && q.counter == p.counter);
  failures += CHECK(trkMemReadConstants(reader, &c) == trkOK && c.blankLeft == 10);
  failures += CHECK(trkMemClose(reader) == trkOK);
  /* The writer is left for the end of the program to close. */
  return failures;
}

static int use_net(int port) {
  int failures = 0;
  int binary;
  for (binary = 0; binary <= 1; ++binary) {
    trkHandle writer = NULL, reader = NULL;
    const trkCameraParams p = make_params();
    const trkCameraConstants constants = make_constants();
    trkCameraParams q;
    trkCameraConstants c;
    failures += CHECK(open_read(port, &reader) == trkOK);
    failures += CHECK(trkNetOpenWrite("127.0.0.1", port, binary, &writer) == trkOK);
    failures += CHECK(trkNetWriteConstants(writer, &constants) == trkOK && trkNetWriteParams(writer, &p) == trkOK);
    failures += CHECK(trkNetReadParams(reader, &q) == trkOK && q.fov == 42.0);
    failures += CHECK(trkNetReadConstants(reader, &c) == trkOK && c.chipWidth == 6.4);
    failures += CHECK(trkNetBufReadParams(reader, &q, 1, 2) == trkUnavailable);
    failures += CHECK(trkNetClose(writer) == trkOK && trkNetClose(reader) == trkOK);
  }
  return failures;
}

static int use_file(const char* name) {
  int failures = 0;
  char time_code[trkTimeCodeSize];
  trkHandle handle = NULL;
  const trkCameraParams p = make_params();
  const trkCameraConstants constants = make_constants();
  trkCameraParams q;
  trkCameraConstants c;
  failures += CHECK(trkFileOpenWrite(name, "01:02:03:04:1", &constants, &handle) == trkOK);
  failures += CHECK(trkFileWriteParams(handle, &p) == trkOK && trkFileClose(handle) == trkOK);
  failures += CHECK(trkFileOpenRead(name, time_code, &c, &handle) == trkOK && strcmp(time_code, "01:02:03:04:1") == 0);
  failures += CHECK(trkFileReadParams(handle, &q) == trkOK && q.counter == p.counter);
  failures += CHECK(trkFileReadParams(handle, &q) == trkUnavailable && trkFileClose(handle) == trkOK);
  return failures;
}

int main(int argc, char** argv) {
  if (argc != 4) {
    fputs("usage: user SLOT PORT FILE\n", stderr);
    return 2;
  }
  return use_text() + use_memory(atoi(argv[1])) + use_net(atoi(argv[2])) + use_file(argv[3]) == 0 ? 0 : 1;
}
