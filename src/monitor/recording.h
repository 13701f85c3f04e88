// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Records a take of one camera in the monitor.
#pragma once

#include <memory>
#include <string>

#include "bridge/outlet.h"
#include "model.h"

namespace trk_bridge::monitor {

/// Records parameters and constants of one id of one sender to a file in the working directory, named by the time of
/// its first record: take-20261129-231500.trk. Slow storage does not block the caller. One thread at a time.
class Recording {
 public:
  ~Recording() { end(); }

  bool is_on() const noexcept { return outlet_ != nullptr; }
  /// Returns a text for the user: the recording has begun, or why it cannot begin.
  std::string begin(const CameraState&);
  /// Records the sample if it belongs to the recorded camera.
  void add(const transport::Sample&);
  /// "recording take-….trk, 251 records"
  std::string status() const;
  /// Returns the result as text: name of the file and number of records, or why there is none. Empty if it was off.
  std::string end();

 private:
  struct FirstLoss;

  cli::Tally::Key key_;
  std::unique_ptr<bridge::Outlet> outlet_;
  std::shared_ptr<FirstLoss> first_loss_;  // the outlet's thread may outlive it
};

}  // namespace trk_bridge::monitor
