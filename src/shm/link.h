// A slot that is kept attached: what was removed, replaced or not yet there is found again.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include <tl/expected.hpp>

#include "segment.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::shm {

/// What one look for a new record met.
enum class ReadResult : std::uint8_t {
  fresh,      ///< a new record
  nothing,    ///< none since the last one
  malformed,  ///< a new one that is not sound
};

/// Reads and writes one slot over all the segments it has in the course of time. Of a segment it attaches to, it reads
/// parameters written from then on, and constants written before as well. One thread at a time; allocates nothing.
class Link {
 public:
  /// Which slot, and what to make where there is nothing.
  struct Options {
    int slot = 0;
    /// Writing makes a segment of this layout where there is none; null: it waits for somebody else's.
    const SegmentLayout* create = nullptr;
    int mode = 0666;        ///< of segments it makes
    bool recreate = false;  ///< trkMemRecreate: a fresh segment whenever all others have left
  };

  /// What `now` is measured with.
  using Clock = std::chrono::steady_clock;
  /// How often it asks whether the slot still means this segment, and looks for one that is not there.
  static constexpr std::chrono::milliseconds check_period{200};
  static constexpr std::chrono::milliseconds attach_period{50};

  explicit Link(const Options& options) noexcept : options_(options) {}

  /// For reading: attaches, or reattaches, when it is time to look; creates nothing. A fault says why there
  /// is no segment.
  [[nodiscard]] tl::expected<void, SlotFault> keep(Clock::time_point now) noexcept;
  /// For writing: looks at every call, for a write into a removed segment would be lost, and makes one where there is
  /// none.
  [[nodiscard]] tl::expected<void, SlotFault> keep_for_writing(Clock::time_point now) noexcept;

  /// Null without a segment.
  const Segment* segment() const noexcept { return segment_ ? &*segment_ : nullptr; }
  /// Segments attached to so far.
  std::uint64_t attached() const noexcept { return attached_; }
  /// Parameters written and replaced by newer ones before they were read.
  std::uint64_t overwritten() const noexcept { return overwritten_; }

  /// The newest parameters (constants) not read yet; `fault` is set with malformed.
  [[nodiscard]] ReadResult read(wire::CameraParams& into, wire::Fault& fault) noexcept;
  [[nodiscard]] ReadResult read(wire::CameraConstants& into, wire::Fault& fault) noexcept;

  /// There must be a segment() that is writable(). A segment made later begins with the constants written last.
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraParams&) noexcept;
  [[nodiscard]] tl::expected<void, wire::Fault> write(const wire::CameraConstants&) noexcept;

  /// Lets go; keep() attaches again.
  void close() noexcept { segment_.reset(); }

 private:
  tl::expected<void, SlotFault> attach(const SegmentLayout* create, Clock::time_point now) noexcept;
  tl::expected<void, SlotFault> check(bool look_up, const SegmentLayout* create, Clock::time_point now) noexcept;
  void begin_reading() noexcept;
  bool look_due(Clock::time_point now, std::chrono::milliseconds period) noexcept;

  Options options_;
  std::optional<Segment> segment_;
  std::optional<SlotFault> absent_;  // why there is no segment, as of the last look
  std::optional<Clock::time_point> looked_;
  std::uint16_t params_read_ = 0;
  std::uint16_t constants_read_ = 0;
  bool constants_unread_ = false;
  bool had_company_ = false;
  std::optional<wire::CameraConstants> written_constants_;
  std::uint64_t attached_ = 0;
  std::uint64_t overwritten_ = 0;
};

}  // namespace trk_bridge::shm
