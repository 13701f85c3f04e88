// Parameters and constants of two topics, put together for outlets.
#pragma once

#include <cstdint>
#include <optional>

#include "constants_origin.h"
#include "outgoing_set.h"
#include "trk_bridge/camera/converter.h"

namespace trk_bridge::bridge {

/// Trivially copyable.
struct ParamsToTrkStatistics {
  std::uint64_t received = 0;       ///< parameters
  std::int64_t last_received = 0;   ///< steady clock, ns; valid once received > 0
  std::uint32_t last_format = 0;    ///< as received
  std::uint64_t bad_constants = 0;  ///< constants that leave no picture: ignored
  ConstantsOrigin constants = ConstantsOrigin::none;
};

/// Not synchronised: one thread at a time. Allocates nothing.
class ParamsToTrk {
 public:
  /// `constants` count until some are taken; they have passed camera::check().
  explicit ParamsToTrk(const std::optional<wire::CameraConstants>& constants = std::nullopt) noexcept;

  /// Takes constants, which go out with the next parameters. The newest sound ones count, whatever their id.
  void use(const wire::CameraConstants&) noexcept;

  /// The parameters as they came, with the constants where outlets need them. `now` is the steady clock, ns.
  OutgoingSet use(const wire::CameraParams&, std::int64_t now) noexcept;

  const ParamsToTrkStatistics& statistics() const noexcept { return statistics_; }

 private:
  std::optional<wire::CameraConstants> newest_;
  camera::Converter given_;  // remembers what outlets have
  ParamsToTrkStatistics statistics_;
};

}  // namespace trk_bridge::bridge
