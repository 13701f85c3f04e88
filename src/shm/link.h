// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Stays attached to a slot: reattaches when the segment was removed, replaced or did not exist yet.
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

/// The result of looking for a new record.
enum class ReadResult : std::uint8_t {
  fresh,      ///< a new record
  nothing,    ///< none since the last one
  malformed,  ///< a new record that is malformed
};

/// Reads and writes one slot, which may have several segments in the course of time. It reads the parameters written
/// after it attached, and also constants written before. One thread at a time; allocates nothing and never waits,
/// except in open_for_writing().
///
/// Programs of the smaller generation (smaller_generation()) can attach to a segment and write records in their own
/// layout. So each record is tried in both layouts and read in the one in which it is plausible. If it is plausible in
/// both, the constants in the segment or the previous records decide. Otherwise it is malformed.
class Link {
 public:
  /// The slot, and what to create if it has no segment.
  struct Options {
    int slot = 0;
    /// Writing creates a segment of this layout if there is none; null: it waits for one of another program.
    const SegmentLayout* create = nullptr;
    int mode = 0666;        ///< of segments that it creates
    bool recreate = false;  ///< trkMemRecreate: recreates the segment when all others have detached
    /// False: keep_for_writing() checks the segment only every `check_period`, as keep() does; what is written to a
    /// removed segment in between is lost. No effect with `recreate`.
    bool checks_every_write = true;
  };

  /// The clock of `now`.
  using Clock = std::chrono::steady_clock;
  /// How often it checks whether the slot still has this segment, and looks for a missing one.
  static constexpr std::chrono::milliseconds check_period{200};
  static constexpr std::chrono::milliseconds attach_period{50};
  /// How long a reader stays attached without others: meanwhile, a writer with larger segments could not open the slot.
  static constexpr std::chrono::seconds alone_limit{1};

  explicit Link(const Options& options) noexcept : options_(options) {}

  /// For reading: attaches or reattaches when a check is due; creates nothing. Detaches from a segment to which nobody
  /// else was attached for `alone_limit`, unless it has written. This removes the segment if the system permits it; if
  /// not, it reattaches when somebody else has. A fault says why there is no segment.
  [[nodiscard]] tl::expected<void, SlotFault> keep(Clock::time_point now) noexcept {
    if (is_kept(now)) return {};
    return keep_now(now);
  }
  /// For writing: by default, checks at every call, because a write to a removed segment would be lost; creates a
  /// segment if there is none.
  [[nodiscard]] tl::expected<void, SlotFault> keep_for_writing(Clock::time_point now) noexcept {
    if (is_kept(now) && !options_.checks_every_write && !options_.recreate) return {};
    return keep_for_writing_now(now);
  }

  /// The same before the first write. Waits up to 0.2 s for others that create or remove the segment; no other function
  /// waits.
  [[nodiscard]] tl::expected<void, SlotFault> open_for_writing() noexcept;

  /// Null without a segment.
  const Segment* segment() const noexcept { return segment_ ? &*segment_ : nullptr; }
  /// Number of segments attached so far.
  std::uint64_t attached() const noexcept { return attached_; }
  /// Whether there are new parameters (constants) to read.
  bool has_new_params() const noexcept { return segment_ && segment_->params_counter() != params_read_; }
  bool has_new_constants() const noexcept {
    return segment_ && (constants_unread_ || segment_->constants_counter() != constants_read_);
  }
  /// Parameters that were replaced by newer ones before they were read.
  std::uint64_t overwritten() const noexcept { return overwritten_; }

  /// The newest parameters (constants) that were not read yet; `fault` is set with malformed.
  [[nodiscard]] ReadResult read(wire::CameraParams& into, transport::Fault& fault) noexcept;
  [[nodiscard]] ReadResult read(wire::CameraConstants& into, transport::Fault& fault) noexcept;
  /// Reads parameters as Segment::Words if their writer is known to use the layout of the segment. If not, it returns
  /// false and has read nothing: read() finds the layout and the faults.
  template <std::size_t count>
  [[nodiscard]] bool read_known_params(Segment::Words<count>& into) noexcept {
    std::uint16_t counter = 0;
    if (!known_head_ || !segment_->copy_params(into, counter) || into[0] != *known_head_) return false;
    count_params(counter);
    read_in_ = segment_->layout().record;
    return true;
  }
  /// The layout of the last record read; before the first, that of the segment.
  wire::Layout read_in() const noexcept { return read_in_; }

  /// Requires a segment() that is writable(). A segment created later starts with the last constants written.
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraParams&) noexcept;
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraConstants&) noexcept;
  template <std::size_t count, typename WordAt>
  void write_params(WordAt&& word_at) noexcept {
    has_written_ = true;
    segment_->write_params<count>(word_at);
  }

  /// Detaches; keep() reattaches.
  void close() noexcept { segment_.reset(); }

 private:
  /// Attached programs and write counters at one moment.
  struct Activity {
    AttachInfo attach_info;
    std::uint16_t params = 0, constants = 0;  ///< write counters
  };
  /// A segment that was detached and could not be removed.
  struct Abandoned {
    int id = -1;
    AttachInfo attach_info;
  };

  tl::expected<void, SlotFault> attach(const SegmentLayout* create, Clock::time_point now) noexcept;
  tl::expected<void, SlotFault> check(bool look_up, const SegmentLayout* create, Clock::time_point now) noexcept;
  void begin_reading(Clock::time_point now) noexcept;
  /// Whether the last check of the segment is recent enough.
  bool is_kept(Clock::time_point now) const noexcept { return segment_ && checked_ && now - *checked_ < check_period; }
  tl::expected<void, SlotFault> keep_now(Clock::time_point now) noexcept;
  tl::expected<void, SlotFault> keep_for_writing_now(Clock::time_point now) noexcept;
  bool begin_check_if_due(Clock::time_point now, std::chrono::milliseconds period) noexcept;
  void count_params(std::uint16_t counter) noexcept {
    overwritten_ += static_cast<std::uint16_t>(counter - params_read_ - 1U);
    params_read_ = counter;
  }
  Activity activity() const noexcept;
  bool is_alone_too_long(Clock::time_point now) noexcept;
  SlotFault release() noexcept;
  bool is_still_abandoned() const noexcept;
  /// The layout of the record in the image; a fault if it is plausible in none, or equally in both.
  tl::expected<const SegmentLayout*, transport::Fault> layout_of_params(const RecordImage& image) noexcept;
  tl::expected<const SegmentLayout*, transport::Fault> layout_of_constants(const RecordImage& image) noexcept;
  /// As layout_of_params(), but skips the check for records of a known writer.
  tl::expected<const SegmentLayout*, transport::Fault> known_layout_of_params(const RecordImage& image) noexcept;

  Options options_;
  std::optional<Segment> segment_;
  std::optional<SlotFault> absent_;  // why there was no segment at the last check
  std::optional<Clock::time_point> checked_;
  std::uint16_t params_read_ = 0;
  std::uint16_t constants_read_ = 0;
  bool constants_unread_ = false;
  const SegmentLayout* writer_layout_ = nullptr;  // of the records; null: not known yet
  // Id and format of the last parameters that were read in the layout of the segment itself: equal words belong to the
  // same writer, whose records need not be checked again.
  std::optional<std::uint64_t> known_head_;
  wire::Layout read_in_{};
  bool had_others_ = false;
  bool has_written_ = false;
  Activity last_activity_;
  std::optional<Clock::time_point> alone_since_;
  std::optional<Abandoned> abandoned_;
  std::optional<wire::CameraConstants> written_constants_;
  std::uint64_t attached_ = 0;
  std::uint64_t overwritten_ = 0;
};

}  // namespace trk_bridge::shm
