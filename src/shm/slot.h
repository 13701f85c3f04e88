// A slot's file and key, and the segment that they lead to.
#pragma once

#include <array>

#include <sys/ipc.h>
#include <sys/shm.h>

#include <tl/expected.hpp>

#include "segment.h"

namespace trk_bridge::shm {

inline SlotFault slot_fault(SlotProblem problem, int slot) noexcept { return {problem, slot, 0, 0, 0, 0}; }
/// With errno.
SlotFault system_fault(int slot) noexcept;

/// The slot file's name without allocating.
class SlotPath {
 public:
  /// The slot must be valid.
  explicit SlotPath(int slot) noexcept;
  const char* c_str() const noexcept { return text_.data(); }

 private:
  std::array<char, 32> text_;
};

/// The key of the slot's file: a fault when there is no such regular file, or the key is of no use.
[[nodiscard]] tl::expected<key_t, SlotFault> slot_key(int slot) noexcept;

/// Makes the slot's file. False when there is one already.
[[nodiscard]] tl::expected<bool, SlotFault> make_slot_file(int slot) noexcept;
/// Puts a file with another inode, and so with another key, in the place of the slot's.
[[nodiscard]] tl::expected<void, SlotFault> renew_slot_file(int slot) noexcept;

/// A fault when another slot's file has this key.
[[nodiscard]] tl::expected<void, SlotFault> check_unshared(int slot, key_t key) noexcept;

struct FoundSegment {
  key_t key;
  int id;
  shmid_ds state;
};
/// The segment that the slot means at this moment. Attaches to nothing.
[[nodiscard]] tl::expected<FoundSegment, SlotFault> find_segment(int slot) noexcept;

}  // namespace trk_bridge::shm
