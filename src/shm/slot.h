// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// File and key of a slot, and the segment with this key.
#pragma once

#include <array>
#include <optional>

#include <sys/ipc.h>
#include <sys/shm.h>

#include <tl/expected.hpp>

#include "segment.h"

namespace trk_bridge::shm {

inline SlotFault slot_fault(SlotProblem problem, int slot) noexcept { return {problem, slot, 0, 0, 0, 0}; }
/// A fault with the current errno.
SlotFault system_fault(int slot) noexcept;

/// The name of the slot file, without allocation.
class SlotPath {
 public:
  /// The slot must be valid.
  explicit SlotPath(int slot) noexcept;
  const char* c_str() const noexcept { return text_.data(); }

 private:
  std::array<char, 32> text_;
};

/// The key of the slot file; a fault if there is no such regular file, or if the key cannot be used.
[[nodiscard]] tl::expected<key_t, SlotFault> slot_key(int slot) noexcept;

/// A temporary file in the same directory that can be exchanged with the slot file. The destructor deletes it.
class SpareFile {
 public:
  [[nodiscard]] static tl::expected<SpareFile, SlotFault> make(int slot) noexcept;
  SpareFile(SpareFile&& other) noexcept : slot_(other.slot_), name_(other.name_) { other.name_[0] = '\0'; }
  SpareFile& operator=(SpareFile&&) = delete;
  ~SpareFile();

  const char* c_str() const noexcept { return name_.data(); }
  /// Becomes the slot file and replaces an existing one.
  bool replace_slot_file() const noexcept;
  /// Becomes the slot file, too, unless there is one: false, with EEXIST in errno.
  bool become_slot_file() const noexcept;
  /// Moves the slot file to this name, so that no program finds it. False if it is gone or belongs to somebody else.
  bool take_slot_file() const noexcept;

 private:
  explicit SpareFile(int slot) noexcept;

  int slot_;
  std::array<char, 48> name_{};
};

/// Creates the slot file; with `replace`, replaces one with an unusable key. Its key is not 0, and no other slot and no
/// segment has it: a reused inode could give the key of a slot whose file was deleted. False if there is a file
/// already.
[[nodiscard]] tl::expected<bool, SlotFault> make_slot_file(int slot, bool replace) noexcept;

/// A fault if the file of another slot has the same key: key_shared, or no_file if the file of this slot is gone.
[[nodiscard]] tl::expected<void, SlotFault> check_unshared(int slot, key_t key) noexcept;

AttachInfo attach_info_of(const shmid_ds& state) noexcept;

struct FoundSegment {
  key_t key;
  int id;
  shmid_ds state;
};
/// The segment that the slot has at this moment. Does not attach.
[[nodiscard]] tl::expected<FoundSegment, SlotFault> find_segment(int slot) noexcept;

}  // namespace trk_bridge::shm
