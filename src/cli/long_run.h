// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Shows the progress of a long run, and ends it on a signal.
#pragma once

#include <chrono>
#include <iosfwd>
#include <stdexcept>
#include <string>

namespace trk_bridge::cli {

/// A signal ended the run (StopSignals).
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Shows progress: nothing for a short run, then one line that is rewritten on a terminal, or a new line every few
/// seconds elsewhere.
class LongRun {
 public:
  LongRun(std::ostream& err, bool is_terminal) : err_(err), is_terminal_(is_terminal) {}
  ~LongRun() { end(); }
  LongRun(const LongRun&) = delete;
  LongRun& operator=(const LongRun&) = delete;

  /// Begins a part of the run, such as "reading take.bag", and ends the part before.
  void begin(std::string what);
  /// Progress from 0 to 1. Throws Interrupted after a signal.
  void at(double fraction);
  /// Removes the progress line from a terminal.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& err_;
  const bool is_terminal_;
  std::string what_;
  Clock::time_point next_;
  bool shown_ = false;
};

}  // namespace trk_bridge::cli
