// Where ros_to_trk takes its sets from.
#pragma once

#include <functional>

#include "bridge/outgoing_set.h"
#include "bridge/status.h"

namespace trk_bridge::nodes {

/// Takes one set to all sinks. Called from one thread at a time.
using SetWriter = std::function<void(const bridge::OutgoingSet&)>;

/// Runs from construction to destruction and hands every set to the SetWriter that it was made with.
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
