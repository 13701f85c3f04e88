// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Process setup for programs and nodes: signals that end it, and standard descriptors.
#pragma once

#include <csignal>

namespace trk_bridge::base {

/// During its lifetime, the first SIGINT or SIGTERM is stored and calls `stop`, which must be safe in a signal handler.
/// More signals within two seconds are ignored: an impatient user or several supervisors must not destroy a recording.
/// A later signal ends the process at once. After a signal, all this remains in effect when the object is destroyed,
/// except that `stop` is not called. Only one object may exist at a time.
class StopSignals {
 public:
  explicit StopSignals(void (*stop)() = nullptr);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Whether a signal was received.
  static bool received() noexcept;

 private:
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

/// Opens standard input, output and error on /dev/null if they are closed: otherwise the next opened file gets their
/// number, and messages are written into it.
void open_standard_descriptors() noexcept;

}  // namespace trk_bridge::base
