// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Storage that does not respond, like a network share whose server is gone.
#pragma once

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <linux/fuse.h>
#include <sys/mount.h>
#include <unistd.h>

namespace trk_bridge::test {

/// Mounted on a directory, in this process's mount namespace: every access to its contents blocks for ever. A blocked
/// process can be killed, as with a network share.
class HungStorage {
 public:
  /// Throws std::runtime_error where the system does not allow it.
  explicit HungStorage(const std::string& directory)
      : directory_(directory), fd_(::open("/dev/fuse", O_RDWR | O_CLOEXEC)) {
    const std::string options = "fd=" + std::to_string(fd_) + ",rootmode=40000,user_id=0,group_id=0";
    if (fd_ < 0 || ::mount("trk_bridge_test", directory.c_str(), "fuse", 0, options.c_str()) != 0) {
      throw std::runtime_error(std::string("no storage of the test's own: ") + std::strerror(errno));
    }
    // The only request that is answered.
    char request[FUSE_MIN_READ_BUFFER];
    if (::read(fd_, request, sizeof request) <= 0) throw std::runtime_error("the kernel does not begin");
    fuse_in_header asked{};
    std::memcpy(&asked, request, sizeof asked);
    struct {
      fuse_out_header header{};
      fuse_init_out init{};
    } answer;
    answer.header.len = sizeof answer;
    answer.header.unique = asked.unique;
    answer.init.major = FUSE_KERNEL_VERSION;
    answer.init.minor = FUSE_KERNEL_MINOR_VERSION;
    answer.init.max_write = 65536;
    if (::write(fd_, &answer, sizeof answer) != static_cast<ssize_t>(sizeof answer)) {
      throw std::runtime_error("the kernel does not take the answer");
    }
  }
  /// Blocked accesses get an error.
  ~HungStorage() {
    ::close(fd_);
    ::umount2(directory_.c_str(), MNT_DETACH);
  }
  HungStorage(const HungStorage&) = delete;
  HungStorage& operator=(const HungStorage&) = delete;

 private:
  const std::string directory_;
  const int fd_;
};

}  // namespace trk_bridge::test
