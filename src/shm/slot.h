// A slot's file and key, and the segment that they lead to.
#pragma once

#include <array>
#include <optional>

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

/// A file beside the slot's, to change places with it. Deleted in the end.
class SpareFile {
 public:
  [[nodiscard]] static tl::expected<SpareFile, SlotFault> make(int slot) noexcept;
  SpareFile(SpareFile&& other) noexcept : slot_(other.slot_), name_(other.name_) { other.name_[0] = '\0'; }
  SpareFile& operator=(SpareFile&&) = delete;
  ~SpareFile();

  const char* c_str() const noexcept { return name_.data(); }
  /// Is the slot's file from now on, in the place of one that is there.
  bool replace_slot_file() const noexcept;
  /// Is the slot's file as well; not where there is one: false, with EEXIST in errno.
  bool become_slot_file() const noexcept;
  /// The slot's file is this one from now on, so that nobody finds it. False when it is gone, or somebody else's.
  bool take_slot_file() const noexcept;

 private:
  explicit SpareFile(int slot) noexcept;

  int slot_;
  std::array<char, 48> name_{};
};

/// Makes the slot's file, with `replace` in the place of one whose key is of no use. Its key is not 0, is no other
/// slot's and leads to no segment: an inode used again would lead into the segment of a slot whose file was deleted.
/// False when there is a file already.
[[nodiscard]] tl::expected<bool, SlotFault> make_slot_file(int slot, bool replace) noexcept;

/// A fault when another slot's file has this key, which the slot's own file had: key_shared, or no_file when it is
/// gone.
[[nodiscard]] tl::expected<void, SlotFault> check_unshared(int slot, key_t key) noexcept;

Attendance attendance_of(const shmid_ds& state) noexcept;

struct FoundSegment {
  key_t key;
  int id;
  shmid_ds state;
};
/// The segment that the slot means at this moment. Attaches to nothing.
[[nodiscard]] tl::expected<FoundSegment, SlotFault> find_segment(int slot) noexcept;

}  // namespace trk_bridge::shm
