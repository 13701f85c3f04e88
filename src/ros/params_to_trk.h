// CameraParams and CameraConstants messages on their way to sinks: judged and told in the outgoing format.
#pragma once

#include <cstdint>
#include <optional>

#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "outgoing.h"

namespace trk_bridge::ros1 {

/// Trivially copyable.
struct ParamsToTrkStatistics {
  OutgoingStatistics outgoing;
  std::uint64_t received = 0;                                ///< CameraParams
  std::uint32_t last_format = 0;                             ///< as received
  std::uint64_t bad_constants = 0;                           ///< constants that leave no picture: ignored
  bool constants_known = false, constants_received = false;  ///< known but not received: from the parameter
};

/// Not synchronised: one thread at a time. Allocates nothing.
class ParamsToTrk {
 public:
  /// `constants` count until some are taken.
  explicit ParamsToTrk(const OutgoingForm&, const std::optional<wire::CameraConstants>& constants = std::nullopt);

  /// Takes constants, which go out with the next parameters. The newest sound ones count, whatever their id.
  void take(const trk_bridge::CameraConstants&);

  /// The set in the outgoing format, with the message's counter; every number that means the same in both formats is
  /// the very double of the message. Nothing where the message is no camera (not finite, no rotation) or cannot be told
  /// in the format. `now` is the steady clock, ns.
  Outgoing take(const trk_bridge::CameraParams&, std::int64_t now);

  const ParamsToTrkStatistics& statistics() const noexcept { return statistics_; }

 private:
  void use(const wire::CameraConstants&);

  OutgoingForm form_;
  std::optional<wire::CameraConstants> incoming_;
  OutgoingConstants outgoing_;
  ParamsToTrkStatistics statistics_;
};

}  // namespace trk_bridge::ros1
