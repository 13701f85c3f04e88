// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// One shared memory segment of a slot (doc/wire_formats.md, "Shared memory"): finds, creates, reads, writes and removes
// it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <string>
#include <string_view>

#include <sys/types.h>

#include <tl/expected.hpp>

#include "segment_layout.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::shm {

/// Slots are 0 to `slot_count` - 1.
inline constexpr int slot_count = 62;
/// The file of the slot, "/tmp/dmc_tracking_buffer.7". The slot must be valid.
std::string slot_path(int slot);

/// What is wrong with a slot.
enum class SlotProblem : std::uint8_t {
  bad_slot,      ///< not 0..61
  no_file,       ///< no program has opened the slot
  no_segment,    ///< the file exists, the segment does not
  unfinished,    ///< a segment without magic and records: being created, or its creator died
  abandoned,     ///< a reader detached from the segment, and nobody has attached since
  foreign,       ///< a segment with the key of the slot that is not trk: `size`, and `magic` if the size was right
  not_a_file,    ///< the name of the slot file belongs to something else
  key_zero,      ///< ftok returns 0, which means "private" to the kernel
  key_shared,    ///< `other_slot` has the same key
  no_key,        ///< every new file has the key of another segment
  exists,        ///< another program created the segment at the same moment
  file_refused,  ///< the system refused the slot file: `error_number`
  system,        ///< a system call on the segment failed: `error_number`
};

/// Why a segment cannot be used. Cheap to copy, never allocates.
struct SlotFault {
  SlotProblem problem;
  int slot = 0;
  std::size_t size = 0;
  std::uint64_t magic = 0;
  int other_slot = 0;
  int error_number = 0;
};
inline bool operator==(const SlotFault& a, const SlotFault& b) noexcept {
  return a.problem == b.problem && a.slot == b.slot && a.size == b.size && a.magic == b.magic &&
         a.other_slot == b.other_slot && a.error_number == b.error_number;
}
/// "slot 7: segment of 300 bytes is not a trk layout".
std::string describe(const SlotFault&);

/// Whether there is no segment yet, so that waiting makes sense.
constexpr bool is_absence(SlotProblem p) noexcept {
  return p == SlotProblem::no_file || p == SlotProblem::no_segment || p == SlotProblem::unfinished ||
         p == SlotProblem::abandoned;
}
/// Whether the next attempt may succeed without a repair by the user.
constexpr bool is_transient(SlotProblem p) noexcept { return is_absence(p) || p == SlotProblem::exists; }

/// A copy of the current record in a segment and its write counter, including the bytes of the current record of
/// smaller_generation().
struct RecordImage {
  std::array<char, record_room> bytes;  ///< the copied bytes
  std::size_t begin = 0;                ///< offset of `bytes` in the segment
  std::size_t at = 0, size = 0;
  std::uint16_t counter = 0;

  /// The record in the layout of the segment.
  std::string_view view() const noexcept { return part(at, size); }
  /// `length` bytes from offset `from` in the segment, which must have been copied.
  std::string_view part(std::size_t from, std::size_t length) const noexcept {
    return {bytes.data() + (from - begin), length};
  }
};

/// The attached processes as the kernel counts them. If two are equal, nobody attached or detached in between, except a
/// process that attached twice within a second.
struct AttachInfo {
  std::size_t attachments = 0;  ///< 0 also if the kernel does not report it
  pid_t last = 0;               ///< the process that attached or detached last
  std::time_t attached = 0, detached = 0;
};
inline bool operator==(const AttachInfo& a, const AttachInfo& b) noexcept {
  return a.attachments == b.attachments && a.last == b.last && a.attached == b.attached && a.detached == b.detached;
}

/// Status of an attached segment.
enum class SegmentStatus : std::uint8_t {
  current,   ///< the slot still has it, or has no segment
  removed,   ///< marked as destroyed: no other process can attach
  replaced,  ///< the slot has another segment now
};

/// What is at an offset of the shared memory. Every access to it is atomic, by the builtins: they also work on memory
/// that is not std::atomic.
template <typename T>
T* shared(char* base, std::size_t offset) noexcept {
  return reinterpret_cast<T*>(base + offset);
}

/// One attachment. `connected` in the segment counts attachments; the last one of any process removes segment and file.
/// The attach count of the kernel determines which one is last, not `connected`, which dead processes leave too high:
/// attaching corrects it to the count of the kernel. Without write permission, a segment is attached read-only and its
/// `connected` is not changed. In a child process after fork(), the copy only detaches the memory.
///
/// One thread at a time per object; any number of processes may read a segment while one writes. Only describe()
/// allocates. Nothing waits or sleeps: attaching and creating try once, and copying gives up after 64 copies that a
/// writer disturbed. Together, the system calls take well under a millisecond.
class Segment {
 public:
  /// Attaches to the segment of the slot. A segment whose size or magic is not that of trk is not changed.
  [[nodiscard]] static tl::expected<Segment, SlotFault> attach(int slot) noexcept;
  /// Attaches, or creates file and segment if there is none. `mode` applies to the new segment, independent of the
  /// umask. Completes a segment whose creator died. If others create or remove it at this moment, the fault
  /// is_transient().
  [[nodiscard]] static tl::expected<Segment, SlotFault> attach_or_create(int slot, const SegmentLayout&,
                                                                         int mode) noexcept;

  Segment(Segment&&) noexcept;
  Segment& operator=(Segment&&) noexcept;
  ~Segment() { close(); }

  /// Detaches, as the destructor does. Closing again does nothing.
  void close() noexcept;

  const SegmentLayout& layout() const noexcept { return *layout_; }
  int id() const noexcept { return id_; }
  bool writable() const noexcept { return writable_; }

  std::int32_t connected() const noexcept;
  /// Includes this attachment.
  AttachInfo attach_info() const noexcept;
  std::size_t attachments() const noexcept { return attach_info().attachments; }
  /// Whether a 32-bit program is attached to a segment of 64-bit programs: its `connected` overlaps the end of their
  /// magic. It writes at other offsets, so that its records cannot be read here.
  bool has_32_bit_program() const noexcept;
  /// With `look_up`, also checks file and key of the slot; without it, detects only `removed`, with one system call.
  SegmentStatus status(bool look_up) const noexcept;

  std::uint16_t params_counter() const noexcept { return counter(layout_->params_counter); }
  std::uint16_t constants_counter() const noexcept { return counter(layout_->constants_counter); }
  /// Whether the newest parameters are from a writer that wakes waiting readers: one of this package, not an existing
  /// program.
  bool is_announced() const noexcept;
  /// A reader that waits until the word is no longer `value`.
  struct Waiter {
    const std::uint32_t* word;
    std::uint32_t value;
  };
  /// The next write of a writer that wakes readers changes the word and wakes those that sleep on it (a futex between
  /// processes). To miss nothing, check for new records after this call and before sleeping. Must be writable().
  Waiter wait_for_write() const noexcept;
  /// Copies the newest parameters. False if a writer changed them during every copy; then `into` is unspecified.
  [[nodiscard]] bool copy_params(RecordImage& into) const noexcept;
  /// Copies the newest constants. False as above.
  [[nodiscard]] bool copy_constants(RecordImage& into) const noexcept;

  /// Writes the next record. If the layout of the segment cannot hold it (a counter above 32 bits in an i386 segment, a
  /// number that is not finite), nothing is written. Must be writable().
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraParams&) noexcept;
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraConstants&) noexcept;

  /// Parameters as `count` words of 8 bytes, in the layout of the segment: its `params_size` must be that of the words,
  /// and `params` multiples of 8. The functions with words are a fast form of those above.
  template <std::size_t count>
  using Words = std::array<std::uint64_t, count>;
  /// Also returns the write counter of these parameters. False as above.
  template <std::size_t count>
  [[nodiscard]] bool copy_params(Words<count>& into, std::uint16_t& counter) const noexcept {
    return copy_unchanged(layout_->params_counter, counter, [&](std::size_t element) {
      const auto* const from = shared<std::uint64_t>(base_, layout_->params[element]);
#pragma GCC unroll 32
      for (std::size_t i = 0; i < count; ++i) into[i] = __atomic_load_n(from + i, __ATOMIC_RELAXED);
    });
  }
  /// `word_at(i)` returns word i. Must be writable().
  template <std::size_t count, typename WordAt>
  void write_params(WordAt&& word_at) noexcept {
    announce();
    put(layout_->params_counter, [&](std::size_t element) {
      auto* const to = shared<std::uint64_t>(base_, layout_->params[element]);
#pragma GCC unroll 32
      for (std::size_t i = 0; i < count; ++i) __atomic_store_n(to + i, word_at(i), __ATOMIC_RELAXED);
    });
  }

  /// trkMemRecreate: replaces this segment by a new one with the same contents. After a fault there is no segment, and
  /// the object is closed.
  [[nodiscard]] tl::expected<void, SlotFault> recreate(int mode) noexcept;

 private:
  // A copy takes well under a microsecond: a tracker does not disturb this many in a row.
  static constexpr int copy_attempts = 64;

  Segment(int slot, int id, char* base, const SegmentLayout& layout, bool writable) noexcept;
  static tl::expected<Segment, SlotFault> create(int slot, const SegmentLayout&, int mode) noexcept;
  static tl::expected<Segment, SlotFault> adopt(int slot) noexcept;
  std::uint16_t counter(std::size_t offset) const noexcept {
    return __atomic_load_n(shared<std::uint16_t>(base_, offset), __ATOMIC_ACQUIRE);
  }
  /// Calls use(0 or 1) with the element of a write counter. A branch, which processors predict: with an index, the use
  /// would wait until the counter is read.
  template <typename Use>
  static void with_element(std::uint16_t counter, Use&& use) noexcept {
    if (counter % 2 == 0) {
      use(std::size_t{0});
    } else {
      use(std::size_t{1});
    }
  }
  /// Calls copy_element(0 or 1) for the newest element until no writer changed it meanwhile. False after
  /// `copy_attempts`.
  template <typename CopyElement>
  bool copy_unchanged(std::size_t counter_at, std::uint16_t& copied, CopyElement&& copy_element) const noexcept {
    for (int i = 0; i < copy_attempts; ++i) {
      copied = counter(counter_at);
      with_element(copied, copy_element);
      std::atomic_thread_fence(std::memory_order_acquire);
      if (__atomic_load_n(shared<std::uint16_t>(base_, counter_at), __ATOMIC_RELAXED) == copied) return true;
    }
    return false;
  }
  bool copy(std::size_t counter_at, std::array<std::size_t, 2> SegmentLayout::*elements,
            std::size_t SegmentLayout::*size, RecordImage& into) const noexcept;
  void announce() noexcept {
    const auto next = static_cast<std::uint16_t>(params_counter() + 1U);
    __atomic_store_n(shared<std::uint32_t>(base_, page_rest::announcement), announcement_mark | next, __ATOMIC_RELAXED);
  }
  /// Calls fill_element(0 or 1) for the element that no reader copies, and makes it the newest.
  template <typename FillElement>
  void put(std::size_t counter_at, FillElement&& fill_element) noexcept {
    auto* const counter = shared<std::uint16_t>(base_, counter_at);
    const auto next = static_cast<std::uint16_t>(__atomic_load_n(counter, __ATOMIC_RELAXED) + 1U);
    // A slow reader may still copy this element: it must first see the counter of the previous write.
    std::atomic_thread_fence(std::memory_order_release);
    with_element(next, fill_element);
    __atomic_store_n(counter, next, __ATOMIC_RELEASE);
    // Either this sees the waiting reader, or the reader sees the new record: both store first and load afterwards.
    std::atomic_thread_fence(std::memory_order_seq_cst);
    const std::uint32_t value = __atomic_load_n(shared<std::uint32_t>(base_, page_rest::wake_word), __ATOMIC_RELAXED);
    if (value % 2 != 0) wake(value);
  }
  void put(std::size_t counter_at, const std::array<std::size_t, 2>& elements, std::string_view image) noexcept;
  void wake(std::uint32_t value) noexcept;
  void count_in() noexcept;
  void correct_count() noexcept;
  void finish() noexcept;
  char* release() noexcept;

  int slot_;
  int id_;
  char* base_;
  const SegmentLayout* layout_;
  bool writable_;
  bool counted_ = false;
  pid_t owner_;
};

}  // namespace trk_bridge::shm
