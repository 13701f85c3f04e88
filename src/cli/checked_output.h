// Lines for whoever reads a program's output, and what becomes of the program when that fails.
#pragma once

#include <iosfwd>
#include <string_view>

#include "exit_code.h"

namespace trk_bridge::cli {

/// Remembers why the first line that could not be written was not.
class CheckedOutput {
 public:
  explicit CheckedOutput(std::ostream& out) : out_(out) {}

  /// A line and its newline; false when that failed, now or before.
  bool line(std::string_view text, bool flush);
  /// Writes what is left and tells `err` of an error. That the reader went away is an ordinary end.
  ExitCode finish(std::ostream& err);

 private:
  bool note_error();

  std::ostream& out_;
  int error_ = 0;
};

}  // namespace trk_bridge::cli
