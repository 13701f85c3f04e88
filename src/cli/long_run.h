// Progress of a long run, and how a signal ends it.
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

/// How far a run is: nothing when it is short, then a line that is rewritten on a terminal, a line every few seconds
/// elsewhere.
class LongRun {
 public:
  LongRun(std::ostream& err, bool is_terminal) : err_(err), is_terminal_(is_terminal) {}
  ~LongRun() { end(); }
  LongRun(const LongRun&) = delete;
  LongRun& operator=(const LongRun&) = delete;

  /// What is done now: "reading take.bag". Ends the part before.
  void begin(std::string what);
  /// From 0 to 1. Throws Interrupted when a signal came.
  void at(double fraction);
  /// Removes the line from a terminal, so that others can be written.
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
