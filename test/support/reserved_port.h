// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A port number for a program that needs one, for the duration of one test.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "file_lock.h"

namespace trk_bridge::test {

/// A UDP port that no socket is bound to and that no other test gets. The kernel does not assign it either: it is below
/// the range of ephemeral ports. A test that can bind port 0 and read its number should do that instead.
class ReservedPort {
 public:
  ReservedPort() {
    for (int number = 20'000; number < 30'000; ++number) {
      FileLock lock("/tmp/trk_bridge_test_port." + std::to_string(number));
      if (!lock.held() || !is_free(static_cast<std::uint16_t>(number))) continue;
      lock_.emplace(std::move(lock));
      number_ = static_cast<std::uint16_t>(number);
      return;
    }
    throw std::runtime_error("no UDP port of 20000 to 29999 is free");
  }

  std::uint16_t number() const { return number_; }
  std::string text() const { return std::to_string(number_); }
  /// Of 127.0.0.1.
  std::string url() const { return "udp://127.0.0.1:" + text(); }

 private:
  static bool is_free(std::uint16_t number) {
    const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (fd < 0) throw std::runtime_error("no socket");
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(number);
    const bool bound = ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::close(fd);
    return bound;
  }

  std::optional<FileLock> lock_;
  std::uint16_t number_ = 0;
};

}  // namespace trk_bridge::test
