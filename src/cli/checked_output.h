// Lines on a program's output, and how the program ends when they cannot be written.
#pragma once

#include <iosfwd>
#include <string_view>

#include "exit_code.h"

namespace trk_bridge::cli {

/// Remembers the error of the first line that could not be written.
class CheckedOutput {
 public:
  explicit CheckedOutput(std::ostream& out) : out_(out) {}

  /// Writes the text and a newline; false when that failed, now or before.
  bool line(std::string_view text, bool flush);
  /// Writes what is left, and an error to `err`. That the reader closed the pipe is an ordinary end.
  ExitCode finish(std::ostream& err);

 private:
  bool note_error();

  std::ostream& out_;
  int error_ = 0;
};

}  // namespace trk_bridge::cli
