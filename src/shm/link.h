// A slot that is kept attached: what was removed, replaced or not yet there is found again.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

#include <tl/expected.hpp>

#include "segment.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::shm {

/// What one look for a new record met.
enum class ReadResult : std::uint8_t {
  fresh,      ///< a new record
  nothing,    ///< none since the last one
  malformed,  ///< a new one that is not sound
};

/// Reads and writes one slot over all the segments it has in the course of time. Of a segment it attaches to, it reads
/// parameters written from then on, and constants written before as well. One thread at a time; allocates nothing and,
/// but for open_for_writing(), never waits.
///
/// Programs of the smaller generation (smaller_generation()) can attach to a segment and write records of their own
/// into it. So a record is read in both layouts: it counts in the one in which it is plausible, and where it is in
/// both, in the one that the constants in the segment, or the records before, speak for. Otherwise it is malformed.
class Link {
 public:
  /// Which slot, and what to make where there is nothing.
  struct Options {
    int slot = 0;
    /// Writing makes a segment of this layout where there is none; null: it waits for somebody else's.
    const SegmentLayout* create = nullptr;
    int mode = 0666;        ///< of segments it makes
    bool recreate = false;  ///< trkMemRecreate: a fresh segment whenever all others have left
    /// False: keep_for_writing() relies on the look before it for `check_period`, as keep() does, and what is written
    /// meanwhile to a segment that was removed is lost. Does not count with `recreate`.
    bool looks_at_every_write = true;
  };

  /// What `now` is measured with.
  using Clock = std::chrono::steady_clock;
  /// How often it asks whether the slot still means this segment, and looks for one that is not there.
  static constexpr std::chrono::milliseconds check_period{200};
  static constexpr std::chrono::milliseconds attach_period{50};
  /// How long a reader stays alone with a segment: a writer whose segments are larger could not open the slot
  /// meanwhile.
  static constexpr std::chrono::seconds alone_limit{1};

  explicit Link(const Options& options) noexcept : options_(options) {}

  /// For reading: attaches, or reattaches, when it is time to look; creates nothing. Lets go of a segment that nobody
  /// else has attached to for `alone_limit`, unless it wrote; that removes it where the system permits, and where not,
  /// it is attached to again when somebody else has. A fault says why there is no segment.
  [[nodiscard]] tl::expected<void, SlotFault> keep(Clock::time_point now) noexcept {
    if (is_kept(now)) return {};
    return keep_now(now);
  }
  /// For writing: as a rule looks at every call, for a write into a removed segment would be lost, and makes one where
  /// there is none.
  [[nodiscard]] tl::expected<void, SlotFault> keep_for_writing(Clock::time_point now) noexcept {
    if (is_kept(now) && !options_.looks_at_every_write && !options_.recreate) return {};
    return keep_for_writing_now(now);
  }

  /// The same, before the first write: the one function that waits, up to 0.2 s for others that make or remove the
  /// segment.
  [[nodiscard]] tl::expected<void, SlotFault> open_for_writing() noexcept;

  /// Null without a segment.
  const Segment* segment() const noexcept { return segment_ ? &*segment_ : nullptr; }
  /// Segments attached to so far.
  std::uint64_t attached() const noexcept { return attached_; }
  /// Whether reading parameters (constants) would not give `nothing`.
  bool has_new_params() const noexcept { return segment_ && segment_->params_counter() != params_read_; }
  bool has_new_constants() const noexcept {
    return segment_ && (constants_unread_ || segment_->constants_counter() != constants_read_);
  }
  /// Parameters written and replaced by newer ones before they were read.
  std::uint64_t overwritten() const noexcept { return overwritten_; }

  /// The newest parameters (constants) not read yet; `fault` is set with malformed.
  [[nodiscard]] ReadResult read(wire::CameraParams& into, transport::Fault& fault) noexcept;
  [[nodiscard]] ReadResult read(wire::CameraConstants& into, transport::Fault& fault) noexcept;
  /// As read() of parameters, but their bytes, in the layout read_in().
  [[nodiscard]] ReadResult read_params(RecordImage& image, std::string_view& bytes, transport::Fault& fault) noexcept;
  /// The layout of the last record read; before one, the segment's.
  wire::Layout read_in() const noexcept { return read_in_; }

  /// There must be a segment() that is writable(). A segment made later begins with the constants written last.
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraParams&) noexcept;
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraConstants&) noexcept;
  /// Parameters in the segment's layout.
  void write_params(std::string_view image) noexcept {
    has_written_ = true;
    segment_->write_params(image);
  }

  /// Lets go; keep() attaches again.
  void close() noexcept { segment_.reset(); }

 private:
  /// What a look at who is attached saw.
  struct Look {
    Attendance attendance;
    std::uint16_t params = 0, constants = 0;  ///< write counters
  };
  /// A segment that was let go of and could not be removed.
  struct Left {
    int id = -1;
    Attendance attendance;
  };

  tl::expected<void, SlotFault> attach(const SegmentLayout* create, Clock::time_point now) noexcept;
  tl::expected<void, SlotFault> check(bool look_up, const SegmentLayout* create, Clock::time_point now) noexcept;
  void begin_reading(Clock::time_point now) noexcept;
  /// Whether the last look at the segment is recent enough.
  bool is_kept(Clock::time_point now) const noexcept { return segment_ && looked_ && now - *looked_ < check_period; }
  tl::expected<void, SlotFault> keep_now(Clock::time_point now) noexcept;
  tl::expected<void, SlotFault> keep_for_writing_now(Clock::time_point now) noexcept;
  bool look_due(Clock::time_point now, std::chrono::milliseconds period) noexcept;
  Look look() const noexcept;
  bool is_alone_too_long(Clock::time_point now) noexcept;
  SlotFault let_go() noexcept;
  bool is_still_deserted() const noexcept;
  /// The layout that the record in the image is written in; a fault when it reads in none, or in both alike.
  tl::expected<const SegmentLayout*, transport::Fault> layout_of_params(const RecordImage& image) noexcept;
  tl::expected<const SegmentLayout*, transport::Fault> layout_of_constants(const RecordImage& image) noexcept;
  /// As layout_of_params(), without judging what is known.
  tl::expected<const SegmentLayout*, transport::Fault> known_layout_of_params(const RecordImage& image) noexcept;

  Options options_;
  std::optional<Segment> segment_;
  std::optional<SlotFault> absent_;  // why there is no segment, as of the last look
  std::optional<Clock::time_point> looked_;
  std::uint16_t params_read_ = 0;
  std::uint16_t constants_read_ = 0;
  bool constants_unread_ = false;
  const SegmentLayout* writer_layout_ = nullptr;  // of the records, as far as they have shown it
  // Id and format of the last parameters that were read in the segment's own layout: the same words again are of the
  // same writer, whose records need not be judged again.
  std::optional<std::array<char, 8>> known_head_;
  wire::Layout read_in_{};
  bool had_company_ = false;
  bool has_written_ = false;
  Look last_look_;
  std::optional<Clock::time_point> alone_since_;
  std::optional<Left> left_;
  std::optional<wire::CameraConstants> written_constants_;
  std::uint64_t attached_ = 0;
  std::uint64_t overwritten_ = 0;
};

}  // namespace trk_bridge::shm
