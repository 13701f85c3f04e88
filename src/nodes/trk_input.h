// Where the sets of ros_to_trk come from.
#pragma once

#include <functional>

#include <ros/transport_hints.h>

#include "bridge/outgoing_set.h"
#include "bridge/status.h"

namespace trk_bridge::nodes {

/// Writes one set to all sinks. Called from one thread at a time.
using SetWriter = std::function<void(const bridge::OutgoingSet&)>;

/// For subscriptions: messages must not wait for others to be sent with them.
inline ::ros::TransportHints no_delay() { return ::ros::TransportHints().tcpNoDelay(); }

/// Runs from construction to destruction and hands every set to the SetWriter that it was constructed with.
class TrkInput {
 public:
  virtual ~TrkInput() = default;
  TrkInput(const TrkInput&) = delete;
  TrkInput& operator=(const TrkInput&) = delete;

  /// Findings of a kind that was not met before go to the log, too. Any thread, one at a time.
  virtual bridge::Status describe() = 0;

 protected:
  TrkInput() = default;
};

}  // namespace trk_bridge::nodes
