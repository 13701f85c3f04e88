// What programs and nodes do with their process: signals that end it, and standard descriptors.
#pragma once

#include <csignal>

namespace trk_bridge::base {

/// While it lives, the first SIGINT or SIGTERM is remembered, and calls `stop`, which must be allowed in a signal
/// handler. More of them within two seconds change nothing: impatient fingers and several supervisors must not cost a
/// recording. One that comes later ends the process at once. Once a signal has come, this stays so after it is
/// destroyed, but for `stop`. One at a time.
class StopSignals {
 public:
  explicit StopSignals(void (*stop)() = nullptr);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Whether one has come.
  static bool received() noexcept;

 private:
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

/// Opens standard input, output and error on /dev/null where they are closed: else the next file that is opened takes
/// their place, and messages are written into it.
void open_standard_descriptors() noexcept;

}  // namespace trk_bridge::base
