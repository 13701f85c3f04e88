// The terminal, while a program has all of it.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "view.h"

namespace trk_bridge::monitor {

/// The whole screen of the terminal that is standard output, and keys from standard input. While it lives, SIGHUP and
/// SIGQUIT are passed on as SIGTERM, so that a program that ends in order at SIGTERM leaves the terminal as it was at
/// these, too; the quit key is off. What handles SIGINT and SIGTERM must be in place before. One at a time, one thread.
class Screen {
 public:
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
  /// The next key, waiting at most `wait` for it; none when there is none. Keys without a character, and a change of
  /// size, are 0.
  std::optional<char> key(std::chrono::milliseconds wait);
  /// Rings the terminal's bell.
  void ring();

 private:
  struct Terminal;
  std::unique_ptr<Terminal> terminal_;
};

}  // namespace trk_bridge::monitor
