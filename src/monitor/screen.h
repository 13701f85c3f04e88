// The terminal, while a program has all of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "view.h"

namespace trk_bridge::monitor {

/// The whole screen of the terminal that is standard output, and keys from standard input. While it lives, SIGHUP and
/// SIGQUIT are passed on as SIGTERM, so that a program that ends in order at SIGTERM leaves the terminal as it was at
/// these, too; the quit key is off. What handles SIGINT and SIGTERM must be in place before. One at a time, one thread.
class Screen {
 public:
  enum class Key : std::uint8_t { none, quit, other };

  /// Throws std::runtime_error when the terminal's type (TERM) is not known. Without colour where the terminal has none
  /// or the environment has NO_COLOR, not empty.
  Screen();
  /// Leaves the terminal as it was.
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// As it is now: its user may change it at any time.
  Size size() const;
  /// Replaces what was shown.
  void show(const std::vector<Line>&);
  /// The next key, waiting at most `wait` for it; a change of size counts as one.
  Key key(std::chrono::milliseconds wait);

 private:
  struct Terminal;
  std::unique_ptr<Terminal> terminal_;
};

}  // namespace trk_bridge::monitor
