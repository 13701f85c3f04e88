// Steps of equal length that do not drift.
#pragma once

#include <cerrno>
#include <chrono>
#include <ctime>
#include <system_error>

#include "cli/stop_signals.h"

namespace trk_bridge::programs {

/// Ends its waiting early when StopSignals has met a signal.
class Pacing {
 public:
  explicit Pacing(std::chrono::nanoseconds step)
      : step_(step), next_(std::chrono::steady_clock::now().time_since_epoch()) {}

  /// Until the next step is due. False when a signal came.
  bool wait() {
    next_ += step_;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(next_);
    const timespec until{static_cast<time_t>(seconds.count()), static_cast<long>((next_ - seconds).count())};
    while (!cli::StopSignals::stopped()) {
      const int error = ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
      if (error == 0) return !cli::StopSignals::stopped();
      if (error != EINTR) throw std::system_error(error, std::generic_category(), "waiting");
    }
    return false;
  }

 private:
  const std::chrono::nanoseconds step_;
  std::chrono::nanoseconds next_;
};

}  // namespace trk_bridge::programs
