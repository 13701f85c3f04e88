// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "stop_signals.h"

#include <atomic>

namespace trk_bridge::cli {
namespace {

std::atomic<transport::Source*> to_stop{nullptr};
static_assert(std::atomic<transport::Source*>::is_always_lock_free, "a signal handler must not take a lock");

void stop() {
  if (transport::Source* source = to_stop.load()) source->stop();
}

/// Must be called before the first signal can arrive.
auto stop_of(transport::Source* source) {
  to_stop.store(source);
  return stop;
}

}  // namespace

StopSignals::StopSignals(transport::Source* source) : signals_(stop_of(source)) {
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &ignore, &pipe_);
}

StopSignals::~StopSignals() {
  ::sigaction(SIGPIPE, &pipe_, nullptr);
  to_stop.store(nullptr);
}

}  // namespace trk_bridge::cli
