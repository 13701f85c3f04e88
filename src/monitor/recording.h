// A take of one camera, recorded while it is watched.
#pragma once

#include <memory>
#include <string>

#include "bridge/outlet.h"
#include "model.h"

namespace trk_bridge::monitor {

/// Records parameters and constants of one id of one sender into a file in the working directory, named by the time of
/// its first record: take-20261129-231500.trk. Storage that is slow delays nothing else. One thread.
class Recording {
 public:
  ~Recording() { end(); }

  bool is_on() const noexcept { return outlet_ != nullptr; }
  /// What to show the user: that it has begun, or why it cannot.
  std::string begin(const CameraState&);
  /// Of any camera: it takes what is its own.
  void add(const transport::Sample&);
  /// "recording take-….trk, 251 records"
  std::string status() const;
  /// What became of it: the file's name and records, or why there is none. Empty where it was off.
  std::string end();

 private:
  struct Trouble;

  cli::Tally::Key key_;
  std::unique_ptr<bridge::Outlet> outlet_;
  std::shared_ptr<Trouble> trouble_;  // the outlet's thread may outlive it
};

}  // namespace trk_bridge::monitor
