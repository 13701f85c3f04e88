/* Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause */
/* Loaded before a program: the kernel has no IPv6, as after ipv6.disable=1 at boot. */
#define _GNU_SOURCE
#include <errno.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

int socket(int domain, int type, int protocol) {
  if (domain == AF_INET6) {
    errno = EAFNOSUPPORT;
    return -1;
  }
  return (int)syscall(SYS_socket, domain, type, protocol);
}
