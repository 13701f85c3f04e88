// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// An unused shared memory slot for the duration of one test.
#pragma once

#include <cerrno>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file_lock.h"

namespace trk_bridge::test {

/// Locks a slot against tests in other processes and removes its file and its segment at the end.
class FreeSlot {
 public:
  FreeSlot() {
    // From the end: existing programs use low slots.
    for (number_ = 61; number_ >= 0; --number_) {
      FileLock lock("/tmp/trk_bridge_test_slot." + std::to_string(number_));
      if (!lock.held() || has_file()) continue;
      lock_.emplace(std::move(lock));
      return;
    }
    throw std::runtime_error("no shared memory slot is free");
  }

  ~FreeSlot() { remove(); }

  FreeSlot(const FreeSlot&) = delete;
  FreeSlot& operator=(const FreeSlot&) = delete;

  int number() const { return number_; }

  std::string path() const {
    const std::string names = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    return std::string("/tmp/dmc_tracking_buffer.") + names[static_cast<std::size_t>(number_)];
  }

  bool has_file() const { return ::access(path().c_str(), F_OK) == 0; }

  /// -1: none.
  int segment() const { return segment_of(path()); }

  /// Does nothing if there is one. Another test may have deleted the file of a segment: a file that gets its inode has
  /// the key of that segment, and is not used.
  void make_file() {
    // It gets the name of the slot at the end: until then, no program creates a segment for it.
    const std::string spare = path() + ".test";
    std::vector<int> files;  // open until the end, so that each has another inode
    for (bool is_usable = false; !is_usable;) {
      files.push_back(::open(spare.c_str(), O_CREAT | O_RDONLY | O_CLOEXEC, 0755));
      if (files.back() < 0) throw std::runtime_error("cannot make " + spare);
      is_usable = segment_of(spare) < 0;
      const bool is_made = !is_usable || ::link(spare.c_str(), path().c_str()) == 0 || errno == EEXIST;
      ::unlink(spare.c_str());
      if (!is_made) throw std::runtime_error("cannot make " + path());
    }
    for (const int fd : files) ::close(fd);
  }

  /// Creates file and segment as another program does. Returns the segment's id.
  int make_segment(std::size_t size, int mode = 0666) {
    make_file();
    const int id = ::shmget(::ftok(path().c_str(), 0), size, IPC_CREAT | IPC_EXCL | mode);
    if (id < 0) throw std::runtime_error("cannot make a segment for " + path());
    return id;
  }

  /// As with ipcrm and rm.
  void remove() {
    if (const int id = segment(); id >= 0) ::shmctl(id, IPC_RMID, nullptr);
    ::unlink(path().c_str());
  }

 private:
  static int segment_of(const std::string& file) {
    const key_t key = ::ftok(file.c_str(), 0);
    return key == -1 ? -1 : ::shmget(key, 0, 0);
  }

  int number_ = -1;
  std::optional<FileLock> lock_;
};

}  // namespace trk_bridge::test
