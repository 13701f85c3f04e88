// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A file that locks a resource against tests in other processes.
#pragma once

#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace trk_bridge::test {

/// Held until it is destroyed. The file is not removed: a lock file that is removed can be held twice.
class FileLock {
 public:
  /// The file is created if it does not exist. held() says whether the lock is held.
  explicit FileLock(const std::string& path) : fd_(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)) {
    if (fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) != 0) ::close(std::exchange(fd_, -1));
  }
  ~FileLock() {
    if (fd_ >= 0) ::close(fd_);
  }
  FileLock(FileLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileLock& operator=(FileLock&&) = delete;

  /// False: another process holds it, or it cannot be opened.
  bool held() const { return fd_ >= 0; }

 private:
  int fd_;
};

}  // namespace trk_bridge::test
