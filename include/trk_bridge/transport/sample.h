// A record with where, when and how it came.
#pragma once

#include <cstdint>
#include <optional>

#include "trk_bridge/base/time_code.h"
#include "trk_bridge/transport/sender.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::transport {

/// What sources hand out. Copying allocates nothing.
struct Sample {
  wire::Record record;
  std::int64_t arrival = 0;  ///< ns since 1970 UTC: the kernel's receive time for datagrams; for files see the source
  Sender sender;
  const char* origin = "";  ///< how it was encoded, for a person; static text: "ASCII", "binary identified_lp64"

  /// False where the protocol has no counter: then the record's counter is 0 and says nothing.
  bool has_counter = true;
  /// False where the protocol has no lens: then of the record's parameters only the pose says anything.
  bool has_lens = true;
  /// When the sender sampled the camera by its own clock, ns since 1970 UTC; none where the protocol has no time.
  std::optional<std::int64_t> sample_time;
  std::optional<base::TimeCode> time_code;  ///< none where the protocol has none
};

}  // namespace trk_bridge::transport
