// Where ros_to_trk takes its sets from.
#pragma once

#include <functional>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "ros/outgoing.h"

namespace trk_bridge::nodes {

/// Takes one set, which has parameters, to all sinks. Called from one thread at a time.
using SetWriter = std::function<void(const trk_bridge::ros1::Outgoing&)>;

/// Runs from construction to destruction and hands every set to the SetWriter that it was made with.
class TrkInput {
 public:
  virtual ~TrkInput() = default;
  TrkInput(const TrkInput&) = delete;
  TrkInput& operator=(const TrkInput&) = delete;

  /// Findings of a kind that was not met before go to the log, too. Any thread, one at a time.
  virtual void describe(diagnostic_updater::DiagnosticStatusWrapper& status) = 0;

 protected:
  TrkInput() = default;
};

}  // namespace trk_bridge::nodes
