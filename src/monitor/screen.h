// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A terminal in full-screen mode.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "view.h"

namespace trk_bridge::monitor {

/// The full screen of the terminal on standard output, and keys from standard input. While it exists, SIGHUP and
/// SIGQUIT are converted to SIGTERM, so that a program that handles SIGTERM restores the terminal after these, too; the
/// quit key is off. Handlers of SIGINT and SIGTERM must be installed before. One object at a time, one thread.
class Screen {
 public:
  /// Throws std::runtime_error if the type of the terminal (TERM) is unknown. No colours if the terminal has none or
  /// NO_COLOR is set and not empty.
  Screen();
  /// Restores the terminal.
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// The current size, which can change at any time.
  Size size() const;
  /// Replaces the content of the screen.
  void show(const std::vector<Line>&);
  /// Waits at most `wait` for a key; none if there is none. Keys without a character, and a change of size, are 0.
  std::optional<char> key(std::chrono::milliseconds wait);
  /// Rings the bell of the terminal.
  void ring();

 private:
  struct Terminal;
  std::unique_ptr<Terminal> terminal_;
};

}  // namespace trk_bridge::monitor
