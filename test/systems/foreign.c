/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* A program of another machine, in the words of the protocol's document alone: what its compiler makes of the
 * structures is what it sends and what it has in shared memory. It is built by compilers for other machines, and for
 * each generation.
 *
 *   foreign sizes            prints the bytes of parameters, constants and a segment
 *   foreign send PORT        sends each record of standard input to 127.0.0.1 in a binary datagram
 *   foreign receive          prints its port, then each record that comes in a binary datagram
 *   foreign write FILE       opens the shared memory with the key of FILE, prints "open", and writes each record of
 *                            standard input; closes at its end, and removes the memory when it is the last
 *   foreign read FILE        waits for that memory, prints "open", then each record that is written there
 *
 * A record is a line: "params ID FORMAT T FOV CENTERX CENTERY K1 K2 FOCDIST APERTURE COUNTER", where T are the 16
 * numbers of the matrix, or "constants ID WIDTH HEIGHT LEFT RIGHT TOP BOTTOM" and the 4 sizes of chips. Doubles are
 * hexadecimal, which is exact. It ends after as many records as COUNT in the environment says. */
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <unistd.h>

#include "trk_struct.h"

enum { header_size = 8, magic = 0x2357BD01 };
static const char params_header[header_size] = {'D', 'M', 'C', '0', '1', 0, 'P', 'B'};
static const char constants_header[header_size] = {'D', 'M', 'C', '0', '1', 0, 'C', 'B'};

typedef struct {
  unsigned long magic;
  int connected;
  unsigned short params_counter, constants_counter;
  trkCameraParams params[2];
  trkCameraConstants constants[2];
} Segment;

typedef struct {
  int is_params;
  trkCameraParams params;
  trkCameraConstants constants;
} Record;

static void fail(const char* what) {
  perror(what);
  exit(1);
}

static double* doubles_of(trkCameraParams* p, int i) {
  double* const lens[7] = {&p->fov, &p->centerX, &p->centerY, &p->k1, &p->k2, &p->focdist, &p->aperture};
  return i < 16 ? &p->t.m[i / 4][i % 4] : lens[i - 16];
}

/* 0 at the end of standard input. */
static int get(Record* record) {
  char kind[16];
  unsigned id;
  int i;
  memset(record, 0, sizeof *record);
  if (scanf("%15s %u", kind, &id) != 2) return 0;
  record->is_params = strcmp(kind, "params") == 0;
  if (record->is_params) {
    trkCameraParams* const p = &record->params;
    if (scanf("%u", &p->format) != 1) return 0;
    for (i = 0; i < 23; ++i) {
      if (scanf("%lf", doubles_of(p, i)) != 1) return 0;
    }
    if (scanf("%lu", &p->counter) != 1) return 0;
  } else {
    trkCameraConstants* const c = &record->constants;
    if (scanf("%d %d %d %d %d %d %lf %lf %lf %lf", &c->imageWidth, &c->imageHeight, &c->blankLeft, &c->blankRight,
              &c->blankTop, &c->blankBottom, &c->chipWidth, &c->chipHeight, &c->fakeChipWidth,
              &c->fakeChipHeight) != 10)
      return 0;
  }
#ifdef TRK_IDENTIFIED
  record->params.id = record->constants.id = id;
#endif
  return 1;
}

static void put_params(const trkCameraParams* p) {
  unsigned id = 0;
  int i;
#ifdef TRK_IDENTIFIED
  id = p->id;
#endif
  printf("params %u %u", id, p->format);
  for (i = 0; i < 23; ++i) printf(" %a", *doubles_of((trkCameraParams*)p, i));
  printf(" %lu\n", p->counter);
}

static void put_constants(const trkCameraConstants* c) {
  unsigned id = 0;
#ifdef TRK_IDENTIFIED
  id = c->id;
#endif
  printf("constants %u %d %d %d %d %d %d %a %a %a %a\n", id, c->imageWidth, c->imageHeight, c->blankLeft, c->blankRight,
         c->blankTop, c->blankBottom, c->chipWidth, c->chipHeight, c->fakeChipWidth, c->fakeChipHeight);
}

static int open_socket(struct sockaddr_in* address, int port) {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  if (fd < 0) fail("socket");
  memset(address, 0, sizeof *address);
  address->sin_family = AF_INET;
  address->sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address->sin_port = htons((unsigned short)port);
  return fd;
}

static void send_records(int port) {
  struct sockaddr_in to;
  const int fd = open_socket(&to, port);
  char bytes[header_size + sizeof(Record)];
  Record record;
  while (get(&record)) {
    const void* const image = record.is_params ? (void*)&record.params : (void*)&record.constants;
    const size_t size = record.is_params ? sizeof record.params : sizeof record.constants;
    memcpy(bytes, record.is_params ? params_header : constants_header, header_size);
    memcpy(bytes + header_size, image, size);
    if (sendto(fd, bytes, header_size + size, 0, (struct sockaddr*)&to, sizeof to) < 0) fail("sendto");
  }
}

static void receive_records(int count) {
  struct sockaddr_in me;
  socklen_t length = sizeof me;
  const int fd = open_socket(&me, 0);
  char bytes[4096];
  if (bind(fd, (struct sockaddr*)&me, sizeof me) != 0 || getsockname(fd, (struct sockaddr*)&me, &length) != 0)
    fail("bind");
  printf("%u\n", (unsigned)ntohs(me.sin_port));
  while (count-- > 0) {
    const ssize_t size = recv(fd, bytes, sizeof bytes, 0);
    trkCameraParams p;
    trkCameraConstants c;
    if (size == (ssize_t)(header_size + sizeof p) && memcmp(bytes, params_header, header_size) == 0) {
      memcpy(&p, bytes + header_size, sizeof p);
      put_params(&p);
    } else if (size == (ssize_t)(header_size + sizeof c) && memcmp(bytes, constants_header, header_size) == 0) {
      memcpy(&c, bytes + header_size, sizeof c);
      put_constants(&c);
    } else {
      printf("other %ld\n", (long)size);
    }
  }
}

/* As the document's programs do: memory that is at least as large as theirs. */
static Segment* attach(const char* file, int flags, int* id) {
  const key_t key = ftok(file, 0);
  Segment* segment;
  *id = key == -1 ? -1 : shmget(key, sizeof(Segment), flags);
  if (*id < 0) return NULL;
  segment = (Segment*)shmat(*id, NULL, 0);
  if (segment == (Segment*)-1) fail("shmat");
  if (segment->magic == 0) segment->magic = magic;
  if (segment->magic != magic) fail("magic");
  ++segment->connected;
  return segment;
}

static void detach(Segment* segment, int id, const char* file) {
  const int is_last = --segment->connected == 0;
  shmdt(segment);
  if (!is_last) return;
  shmctl(id, IPC_RMID, NULL);
  unlink(file);
}

static void write_records(const char* file) {
  int id;
  FILE* const made = fopen(file, "a");
  Segment* segment;
  Record record;
  if (made != NULL) fclose(made);
  segment = attach(file, IPC_CREAT | 0666, &id);
  if (segment == NULL) fail("shmget");
  puts("open");
  while (get(&record)) {
    unsigned short* const counter = record.is_params ? &segment->params_counter : &segment->constants_counter;
    const unsigned short next = (unsigned short)(*counter + 1);
    if (record.is_params) {
      memcpy(&segment->params[next & 1], &record.params, sizeof record.params);
    } else {
      memcpy(&segment->constants[next & 1], &record.constants, sizeof record.constants);
    }
    __sync_synchronize();
    *counter = next;
    puts("written");
  }
  detach(segment, id, file);
}

static void read_records(const char* file, int count) {
  int id;
  Segment* segment;
  unsigned short params_counter = 0, constants_counter = 0;
  while ((segment = attach(file, 0666, &id)) == NULL) usleep(1000);
  puts("open");
  while (count > 0) {
    volatile Segment* const now = segment;
    if (now->constants_counter != constants_counter) {
      constants_counter = now->constants_counter;
      __sync_synchronize();
      put_constants(&segment->constants[constants_counter & 1]);
      --count;
    } else if (now->params_counter != params_counter) {
      params_counter = now->params_counter;
      __sync_synchronize();
      put_params(&segment->params[params_counter & 1]);
      --count;
    } else {
      usleep(500);
    }
  }
  detach(segment, id, file);
}

int main(int argc, char** argv) {
  const char* const count = getenv("COUNT");
  const char* const what = argc > 1 ? argv[1] : "";
  setvbuf(stdout, NULL, _IOLBF, 0);
  if (strcmp(what, "sizes") == 0) {
    printf("%u %u %u\n", (unsigned)sizeof(trkCameraParams), (unsigned)sizeof(trkCameraConstants),
           (unsigned)sizeof(Segment));
  } else if (strcmp(what, "send") == 0 && argc > 2) {
    send_records(atoi(argv[2]));
  } else if (strcmp(what, "receive") == 0) {
    receive_records(count ? atoi(count) : 0);
  } else if (strcmp(what, "write") == 0 && argc > 2) {
    write_records(argv[2]);
  } else if (strcmp(what, "read") == 0 && argc > 2) {
    read_records(argv[2], count ? atoi(count) : 0);
  } else {
    return 2;
  }
  return 0;
}
