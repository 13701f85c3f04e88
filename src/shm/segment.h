// One shared memory segment of a slot (doc/wire_formats.md, "Shared memory"): finding, making, reading, writing and
// removing it.
#pragma once

#include <array>
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
/// The slot's file, "/tmp/dmc_tracking_buffer.7". The slot must be valid.
std::string slot_path(int slot);

/// What is wrong with a slot.
enum class SlotProblem : std::uint8_t {
  bad_slot,    ///< not 0..61
  no_file,     ///< nobody has opened the slot
  no_segment,  ///< the file is there, the segment is not
  unfinished,  ///< a segment without magic and records: being created, or its creator died
  deserted,    ///< a reader let go of the segment, and nobody has attached since
  foreign,     ///< a segment under the slot's key that is not trk: `size`, and `magic` where the size was right
  not_a_file,  ///< something else has the slot file's name
  key_zero,    ///< ftok gives 0, which the kernel takes for "private"
  key_shared,  ///< `other_slot` has the same key
  no_key,      ///< every new file has the key of another segment
  exists,      ///< somebody else made the segment at the same moment
  system,      ///< the kernel refused: `error_number`
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
/// "slot 7: segment of 300 bytes is no trk layout".
std::string describe(const SlotFault&);

/// Whether the fault is that there is nothing yet, so that waiting makes sense.
constexpr bool is_absence(SlotProblem p) noexcept {
  return p == SlotProblem::no_file || p == SlotProblem::no_segment || p == SlotProblem::unfinished ||
         p == SlotProblem::deserted;
}
/// Whether the next look may well find, or make, a segment without anybody having mended anything.
constexpr bool is_transient(SlotProblem p) noexcept { return is_absence(p) || p == SlotProblem::exists; }

/// A record as it lies in a segment, and the write counter it was current at; with it the bytes around it that the
/// current record of smaller_generation() has.
struct RecordImage {
  std::array<char, record_room> bytes;  ///< as far as they were copied
  std::size_t begin = 0;                ///< where `bytes` begin in the segment
  std::size_t at = 0, size = 0;
  std::uint16_t counter = 0;

  /// The record in the segment's own layout.
  std::string_view view() const noexcept { return part(at, size); }
  /// What lies from `from` on in the segment, which must be within the bytes copied.
  std::string_view part(std::size_t from, std::size_t length) const noexcept {
    return {bytes.data() + (from - begin), length};
  }
};

/// Who is attached to a segment, as the kernel has it. Equal ones: nobody came or went, but for a process that came
/// twice within a second.
struct Attendance {
  std::size_t attachments = 0;  ///< 0 also when the kernel cannot say
  pid_t last = 0;               ///< process that attached or detached last
  std::time_t attached = 0, detached = 0;
};
inline bool operator==(const Attendance& a, const Attendance& b) noexcept {
  return a.attachments == b.attachments && a.last == b.last && a.attached == b.attached && a.detached == b.detached;
}

/// What has become of an attached segment.
enum class SegmentFate : std::uint8_t {
  current,   ///< the slot still means it, or means nothing
  removed,   ///< marked destroyed: nobody new will come to it
  replaced,  ///< the slot means another segment now
};

/// One attachment. `connected` in the segment goes up with it and down when it ends; the last attachment of any process
/// removes segment and file. Who is last is the kernel's attach count, not `connected`, which dead processes leave too
/// high: attaching sets it to the kernel's count where the two differ. A segment without write permission is attached
/// for reading alone and its `connected` left as it is. In a child after fork() the copy only lets go of the memory.
///
/// Functions may be called from any thread that has the object to itself; any number of processes read one segment
/// while one writes. Nothing allocates but describe(). Nothing waits or sleeps: attaching looks once, making tries
/// once, copying gives up after 64 copies that a writer disturbed, all together well under a millisecond of system
/// calls.
class Segment {
 public:
  /// Attaches to the slot's segment. A segment that is not trk in size and magic is left exactly as it is.
  [[nodiscard]] static tl::expected<Segment, SlotFault> attach(int slot) noexcept;
  /// Attaches, or makes file and segment where there is none. `mode` is the new segment's, whatever the umask. Takes
  /// over from a maker that died half way. Where others make or remove it at this moment, the fault is_transient().
  [[nodiscard]] static tl::expected<Segment, SlotFault> attach_or_create(int slot, const SegmentLayout&,
                                                                         int mode) noexcept;

  Segment(Segment&&) noexcept;
  Segment& operator=(Segment&&) noexcept;
  ~Segment() { close(); }

  /// Ends the attachment as the destructor does. Closing again does nothing.
  void close() noexcept;

  const SegmentLayout& layout() const noexcept { return *layout_; }
  int id() const noexcept { return id_; }
  bool writable() const noexcept { return writable_; }

  std::int32_t connected() const noexcept;
  /// This attachment included.
  Attendance attendance() const noexcept;
  std::size_t attachments() const noexcept { return attendance().attachments; }
  /// Whether a 32-bit program is attached to a segment of 64-bit programs: its `connected` is where their magic ends.
  /// It counts and writes elsewhere, so that its records are not seen here.
  bool has_32_bit_program() const noexcept;
  /// `look_up`: ask for the slot's file and key, too; without it only `removed` is noticed, by one system call.
  SegmentFate fate(bool look_up) const noexcept;

  std::uint16_t params_counter() const noexcept { return counter(layout_->params_counter); }
  std::uint16_t constants_counter() const noexcept { return counter(layout_->constants_counter); }
  /// Whether the newest parameters are of a writer that wakes who waits: one of this package, not of the field.
  bool is_announced() const noexcept;
  /// Somebody who waits until the word is no longer `value`.
  struct Waiter {
    const std::uint32_t* word;
    std::uint32_t value;
  };
  /// The next write of a writer that wakes changes the word and wakes who sleeps for it (a futex between processes).
  /// What was written before is not missed by who looks after this call and then sleeps. Must be writable().
  Waiter wait_for_write() const noexcept;
  /// Copies the newest record. False when a writer changed it every time: then `into` holds nothing of use.
  [[nodiscard]] bool copy_params(RecordImage& into) const noexcept;
  /// Copies the newest constants. False as above.
  [[nodiscard]] bool copy_constants(RecordImage& into) const noexcept;

  /// Writes the next record. The fault is that the segment's layout cannot hold it (a counter above 32 bits in an i386
  /// segment, a number that is not finite): then nothing is written. Must be writable().
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraParams&) noexcept;
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraConstants&) noexcept;
  /// Writes parameters that are in the segment's layout already, of its `params_size`.
  void write_params(std::string_view image) noexcept {
    announce();
    put(layout_->params_counter, layout_->params, image);
  }

  /// trkMemRecreate: removes this segment and goes on in a fresh one with the same contents. On a fault there is no
  /// segment left: the object is closed.
  [[nodiscard]] tl::expected<void, SlotFault> recreate(int mode) noexcept;

 private:
  Segment(int slot, int id, char* base, const SegmentLayout& layout, bool writable) noexcept;
  static tl::expected<Segment, SlotFault> create(int slot, const SegmentLayout&, int mode) noexcept;
  static tl::expected<Segment, SlotFault> adopt(int slot) noexcept;
  // Shared with other processes: atomic.
  std::uint16_t counter(std::size_t at) const noexcept {
    return __atomic_load_n(reinterpret_cast<const std::uint16_t*>(base_ + at), __ATOMIC_ACQUIRE);
  }
  bool copy(std::size_t counter_at, std::array<std::size_t, 2> SegmentLayout::*elements,
            std::size_t SegmentLayout::*size, RecordImage& into) const noexcept;
  void announce() noexcept;
  void wake() noexcept;
  void put(std::size_t counter_at, const std::array<std::size_t, 2>& elements, std::string_view image) noexcept;
  void count_in() noexcept;
  void correct_count() noexcept;
  void finish() noexcept;
  char* let_go() noexcept;

  int slot_;
  int id_;
  char* base_;
  const SegmentLayout* layout_;
  bool writable_;
  bool counted_ = false;
  pid_t owner_;
};

}  // namespace trk_bridge::shm
