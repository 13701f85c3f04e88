#include "stop_signals.h"

#include <atomic>

namespace trk_bridge::cli {
namespace {

std::atomic<transport::Source*> to_stop{nullptr};
std::atomic<bool> came{false};
static_assert(std::atomic<transport::Source*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler must not meet a lock");

extern "C" void trk_bridge_stop(int) {
  came.store(true);
  if (transport::Source* source = to_stop.load()) source->stop();
}

}  // namespace

StopSignals::StopSignals(transport::Source* source) {
  came.store(false);
  to_stop.store(source);
  struct sigaction stop {};
  stop.sa_handler = trk_bridge_stop;
  // The first flag is the highest bit.
  stop.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  ::sigaction(SIGINT, &stop, &interrupt_);
  ::sigaction(SIGTERM, &stop, &terminate_);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &ignore, &pipe_);
}

StopSignals::~StopSignals() {
  ::sigaction(SIGINT, &interrupt_, nullptr);
  ::sigaction(SIGTERM, &terminate_, nullptr);
  ::sigaction(SIGPIPE, &pipe_, nullptr);
  to_stop.store(nullptr);
}

bool StopSignals::stopped() noexcept { return came.load(); }

}  // namespace trk_bridge::cli
