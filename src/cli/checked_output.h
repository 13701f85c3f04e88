// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Writes lines to the output of a program, and handles write errors.
#pragma once

#include <iosfwd>
#include <string_view>

#include "exit_code.h"

namespace trk_bridge::cli {

/// Remembers the error of the first line that could not be written.
class CheckedOutput {
 public:
  explicit CheckedOutput(std::ostream& out) : out_(out) {}

  /// Writes the text and a newline; false if this or an earlier write failed.
  bool line(std::string_view text, bool flush);
  /// Flushes the output, and writes an error to `err`. A pipe that its reader closed is not an error.
  ExitCode finish(std::ostream& err);

 private:
  bool note_error();

  std::ostream& out_;
  int error_ = 0;
};

}  // namespace trk_bridge::cli
