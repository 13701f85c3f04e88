// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "checked_output.h"

#include <cerrno>
#include <ostream>

#include "base/system_text.h"

namespace trk_bridge::cli {

bool CheckedOutput::line(std::string_view text, bool flush) {
  if (error_ != 0) return false;
  errno = 0;
  out_ << text << '\n';
  if (flush) out_.flush();
  return note_error();
}

ExitCode CheckedOutput::finish(std::ostream& err) {
  if (error_ == 0) {
    errno = 0;
    out_.flush();
    note_error();
  }
  if (error_ == 0 || error_ == EPIPE) return exit_good;
  err << "trk: error: standard output: " << base::system_text(error_) << '\n';
  return exit_failed;
}

bool CheckedOutput::note_error() {
  if (out_) return true;
  error_ = errno != 0 ? errno : EIO;
  return false;
}

}  // namespace trk_bridge::cli
