// What both inputs of ros_to_trk have in common on the way out.
#pragma once

#include <cstdint>
#include <optional>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

/// How records have to be told.
struct OutgoingForm {
  std::uint32_t format = wire::euler;  ///< FormatBit mask that a record may be made in
  bool sends_id = true;                ///< false: the receiver can take none, and 0 is sent
  std::optional<std::uint32_t> id;     ///< instead of what messages say
};

/// What is to be written to every sink, constants first. Constants come with parameters only: these tell their id.
struct Outgoing {
  std::optional<wire::CameraConstants> constants;  ///< where they differ from the last ones, or the id does
  std::optional<wire::CameraParams> params;
};

/// What became of a camera's messages so far. Trivially copyable.
struct OutgoingStatistics {
  std::uint64_t sets = 0;         ///< made for the sinks
  std::int64_t last_set = 0;      ///< steady clock, ns; counts once sets > 0
  std::uint64_t dropped = 0;      ///< sets that are no camera at all; `drop_reason` says why the last one was not
  std::uint64_t withheld = 0;     ///< sets that cannot be told in the format; `withhold_reason`
  std::uint32_t last_id = 0;      ///< as sent
  std::uint32_t left_out_id = 0;  ///< the last one that was not sent since the receiver can take none
  camera::CameraReason drop_reason{}, withhold_reason{};
};

/// The id to send for a message's one; statistics tell it, and one that has to be left out.
std::uint32_t sent_id(const OutgoingForm&, std::uint32_t of_message, OutgoingStatistics&) noexcept;

/// The outgoing constants, and whether the sinks need them now. Not synchronised, never allocates.
class OutgoingConstants {
 public:
  explicit OutgoingConstants(std::uint32_t format) noexcept : format_(format) {}

  /// Takes constants that have passed check(); their fake chip is made to agree with the format, their id is not kept.
  void use(const wire::CameraConstants&) noexcept;
  /// Null before any.
  const wire::CameraConstants* get() const noexcept { return constants_ ? &*constants_ : nullptr; }
  /// What has to go out before parameters with this id.
  std::optional<wire::CameraConstants> news(std::uint32_t id) noexcept;

 private:
  std::uint32_t format_;
  std::optional<wire::CameraConstants> constants_, told_;
};

}  // namespace trk_bridge::ros1
