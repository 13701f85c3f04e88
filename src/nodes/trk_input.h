// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The interface of the inputs of ros_to_trk.
#pragma once

#include <functional>

#include <ros/transport_hints.h>

#include "bridge/outgoing_set.h"
#include "bridge/status.h"

namespace trk_bridge::nodes {

/// Writes one set to all sinks. Called from one thread at a time.
using SetWriter = std::function<void(const bridge::OutgoingSet&)>;

/// For subscriptions: messages must not wait to be sent together with others.
inline ::ros::TransportHints no_delay() { return ::ros::TransportHints().tcpNoDelay(); }

/// Runs from construction to destruction and passes every set to the SetWriter that it was constructed with.
class TrkInput {
 public:
  virtual ~TrkInput() = default;
  TrkInput(const TrkInput&) = delete;
  TrkInput& operator=(const TrkInput&) = delete;

  /// The first finding of each kind is also logged. Any thread, one at a time.
  virtual bridge::Status describe() = 0;

 protected:
  TrkInput() = default;
};

}  // namespace trk_bridge::nodes
