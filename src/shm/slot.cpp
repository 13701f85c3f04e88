// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "slot.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/system_text.h"

namespace trk_bridge::shm {
namespace {

constexpr std::string_view prefix = "/tmp/dmc_tracking_buffer.";
constexpr std::string_view characters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
static_assert(characters.size() == slot_count);

// Existing programs use this mode; only the inode matters.
constexpr mode_t file_mode = 0755;

std::string hexadecimal(std::uint64_t value) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "0x%llX", static_cast<unsigned long long>(value));
  return text.data();
}

SlotFault file_fault(int slot) noexcept { return {SlotProblem::file_refused, slot, 0, 0, 0, errno}; }

std::string describe_problem(const SlotFault& f) {
  const std::string size = std::to_string(f.size);
  switch (f.problem) {
    case SlotProblem::bad_slot:
      return "no such slot; slots are 0 to " + std::to_string(slot_count - 1);
    case SlotProblem::no_file:
    case SlotProblem::no_segment:
      return "no segment";
    case SlotProblem::unfinished:
      return "segment of " + size + " bytes is empty: its creator has not finished it";
    case SlotProblem::abandoned:
      return "no other program is attached to its segment";
    case SlotProblem::foreign:
      if (layout_of_size(f.size) == nullptr) return "segment of " + size + " bytes is not a trk layout";
      return "segment of " + size + " bytes begins with " + hexadecimal(f.magic) + " instead of " +
             hexadecimal(segment_magic) + " and is not trk";
    case SlotProblem::not_a_file:
      return slot_path(f.slot) + " is not a regular file";
    case SlotProblem::key_zero:
      return slot_path(f.slot) + " has the key 0, which cannot be shared; delete the file";
    case SlotProblem::key_shared:
      return "has the same key as slot " + std::to_string(f.other_slot) + "; delete " + slot_path(f.slot) + " or " +
             slot_path(f.other_slot) + ", whichever is not in use";
    case SlotProblem::no_key:
      return "every new file in /tmp has the key of another segment";
    case SlotProblem::exists:
      return "another program creates or removes the segment at the same time";
    case SlotProblem::file_refused:
      return slot_path(f.slot) + ": " + base::system_text(f.error_number);
    case SlotProblem::system:
      return base::system_text(f.error_number);
  }
  return "unknown problem";
}

}  // namespace

std::string describe(const SlotFault& fault) {
  return "slot " + std::to_string(fault.slot) + ": " + describe_problem(fault);
}

SlotFault system_fault(int slot) noexcept { return {SlotProblem::system, slot, 0, 0, 0, errno}; }

SlotPath::SlotPath(int slot) noexcept : text_{} {
  static_assert(prefix.size() + 2 <= sizeof text_);
  std::copy(prefix.begin(), prefix.end(), text_.begin());
  text_[prefix.size()] = characters[static_cast<std::size_t>(slot)];
}

std::string slot_path(int slot) { return SlotPath(slot).c_str(); }

tl::expected<key_t, SlotFault> slot_key(int slot) noexcept {
  if (slot < 0 || slot >= slot_count) return tl::unexpected(slot_fault(SlotProblem::bad_slot, slot));
  const SlotPath path(slot);
  struct stat state {};
  if (::lstat(path.c_str(), &state) != 0) {
    return tl::unexpected(errno == ENOENT ? slot_fault(SlotProblem::no_file, slot) : file_fault(slot));
  }
  if (!S_ISREG(state.st_mode)) return tl::unexpected(slot_fault(SlotProblem::not_a_file, slot));
  const key_t key = ::ftok(path.c_str(), 0);
  if (key == -1) {
    return tl::unexpected(errno == ENOENT ? slot_fault(SlotProblem::no_file, slot) : file_fault(slot));
  }
  if (key == IPC_PRIVATE) return tl::unexpected(slot_fault(SlotProblem::key_zero, slot));
  return key;
}

tl::expected<void, SlotFault> check_unshared(int slot, key_t key) noexcept {
  for (int other = 0; other < slot_count; ++other) {
    if (other == slot || slot_key(other).value_or(IPC_PRIVATE) != key) continue;
    // The file of this slot may have been removed meanwhile, and its inode reused.
    if (slot_key(slot).value_or(IPC_PRIVATE) != key) return tl::unexpected(slot_fault(SlotProblem::no_file, slot));
    SlotFault fault = slot_fault(SlotProblem::key_shared, slot);
    fault.other_slot = other;
    return tl::unexpected(fault);
  }
  return {};
}

SpareFile::SpareFile(int slot) noexcept : slot_(slot) {
  std::snprintf(name_.data(), name_.size(), "%s.XXXXXX", SlotPath(slot).c_str());
}

tl::expected<SpareFile, SlotFault> SpareFile::make(int slot) noexcept {
  SpareFile spare(slot);
  const int fd = ::mkostemp(spare.name_.data(), O_CLOEXEC);
  if (fd < 0) {
    const SlotFault fault = file_fault(slot);
    spare.name_[0] = '\0';
    return tl::unexpected(fault);
  }
  const bool ready = ::fchmod(fd, file_mode) == 0;
  const SlotFault fault = file_fault(slot);
  ::close(fd);
  if (!ready) return tl::unexpected(fault);
  return spare;
}

SpareFile::~SpareFile() {
  if (name_[0] != '\0') ::unlink(name_.data());
}

bool SpareFile::replace_slot_file() const noexcept { return ::rename(c_str(), SlotPath(slot_).c_str()) == 0; }
bool SpareFile::become_slot_file() const noexcept { return ::link(c_str(), SlotPath(slot_).c_str()) == 0; }
bool SpareFile::take_slot_file() const noexcept { return ::rename(SlotPath(slot_).c_str(), c_str()) == 0; }

tl::expected<bool, SlotFault> make_slot_file(int slot, bool replace) noexcept {
  // Unusable files are kept until the end, so that the next one has another inode.
  std::array<std::optional<SpareFile>, 8> spares;
  for (auto& spare : spares) {
    auto made = SpareFile::make(slot);
    if (!made) return tl::unexpected(made.error());
    spare.emplace(std::move(*made));
    const key_t key = ::ftok(spare->c_str(), 0);
    const bool usable =
        key != -1 && key != IPC_PRIVATE && check_unshared(slot, key) && ::shmget(key, 0, 0) < 0 && errno == ENOENT;
    if (!usable) continue;
    if (replace ? spare->replace_slot_file() : spare->become_slot_file()) return true;
    if (errno == EEXIST) return false;
    return tl::unexpected(file_fault(slot));
  }
  return tl::unexpected(slot_fault(SlotProblem::no_key, slot));
}

AttachInfo attach_info_of(const shmid_ds& state) noexcept {
  return {state.shm_nattch, state.shm_lpid, state.shm_atime, state.shm_dtime};
}

tl::expected<FoundSegment, SlotFault> find_segment(int slot) noexcept {
  const auto key = slot_key(slot);
  if (!key) return tl::unexpected(key.error());
  FoundSegment found{*key, ::shmget(*key, 0, 0), {}};
  if (found.id < 0) {
    return tl::unexpected(errno == ENOENT ? slot_fault(SlotProblem::no_segment, slot) : system_fault(slot));
  }
  if (::shmctl(found.id, IPC_STAT, &found.state) != 0) {
    const bool gone = errno == EINVAL || errno == EIDRM;
    return tl::unexpected(gone ? slot_fault(SlotProblem::no_segment, slot) : system_fault(slot));
  }
  return found;
}

}  // namespace trk_bridge::shm
