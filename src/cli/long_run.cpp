// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "long_run.h"

#include <algorithm>
#include <ostream>
#include <utility>

#include "stop_signals.h"

namespace trk_bridge::cli {
namespace {

constexpr std::chrono::milliseconds terminal_period{200};
constexpr std::chrono::seconds line_period{5};

}  // namespace

void LongRun::begin(std::string what) {
  end();
  what_ = std::move(what);
  next_ = Clock::now() + (is_terminal_ ? std::chrono::nanoseconds(terminal_period) : line_period);
}

void LongRun::at(double fraction) {
  if (StopSignals::stopped()) throw Interrupted("interrupted; nothing was written");
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (is_terminal_ ? std::chrono::nanoseconds(terminal_period) : line_period);
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
  if (is_terminal_) {
    err_ << "\r\033[Ktrk: " << what_ << ": " << percent << " %" << std::flush;
    shown_ = true;
  } else {
    err_ << "trk: " << what_ << ": " << percent << " %" << std::endl;
  }
}

void LongRun::end() {
  if (shown_) err_ << "\r\033[K" << std::flush;
  shown_ = false;
}

}  // namespace trk_bridge::cli
