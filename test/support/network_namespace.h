// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Private networks of a test, which can add and remove their interfaces.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

namespace trk_bridge::test {

/// A network namespace that has only a loopback interface, which is up. It ends with its last descriptor and socket.
class NetworkNamespace {
 public:
  /// Throws std::runtime_error with the reason, for GTEST_SKIP: users other than root may not be allowed to create one.
  NetworkNamespace() {
    int error = 0;
    std::thread([&] {
      if (::unshare(CLONE_NEWNET) == 0) fd_ = current();
      error = errno;
    }).join();
    if (fd_ < 0)
      throw std::runtime_error(std::string("no network namespace (root is needed): ") + std::strerror(error));
    ip("link set lo up");
  }
  ~NetworkNamespace() { ::close(fd_); }
  NetworkNamespace(const NetworkNamespace&) = delete;
  NetworkNamespace& operator=(const NetworkNamespace&) = delete;

  /// While it exists, new sockets, threads and processes of this thread are in the namespace.
  class Stay {
   public:
    explicit Stay(const NetworkNamespace& in) : before_(current()) { enter(in.fd_); }
    ~Stay() {
      enter(before_);
      ::close(before_);
    }
    Stay(const Stay&) = delete;
    Stay& operator=(const Stay&) = delete;

   private:
    static void enter(int fd) {
      if (::setns(fd, CLONE_NEWNET) != 0) throw std::runtime_error(std::string("setns: ") + std::strerror(errno));
    }
    int before_;
  };

  /// Lines for `ip -batch`. Throws std::runtime_error if one fails.
  void ip(const std::string& lines) const {
    const Stay stay(*this);
    std::FILE* program = ::popen("ip -batch -", "we");
    if (program == nullptr) throw std::runtime_error("ip (of iproute2) does not start");
    std::fputs((lines + "\n").c_str(), program);
    if (::pclose(program) != 0) throw std::runtime_error("ip refused one of:\n" + lines);
  }

  /// As `ip link … netns PATH` takes it.
  std::string path() const { return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(fd_); }

 private:
  static int current() { return ::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC); }

  int fd_ = -1;
};

}  // namespace trk_bridge::test
