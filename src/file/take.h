// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A take: a text file with the parameters of one camera, one set per video field (doc/wire_formats.md, "File").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "transport/socket.h"
#include "trk_bridge/base/time_code.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::file {

/// What to do with a malformed line of parameters.
enum class MalformedLines : std::uint8_t { are_errors, are_skipped };

/// Whether a reader of a FIFO waits for the writer.
enum class Waiting : std::uint8_t { blocks, never };

/// Reads a take line by line on request, in memory of fixed size: a line of 4096 bytes or more is malformed. Errors of
/// a line are found when next() reads it. Lines may end with LF or CRLF, and the file may begin with a UTF-8 byte order
/// mark. One thread at a time.
///
/// A last line without a line end is *truncated* if it is malformed, or if its counter is below the previous one
/// (digits may be missing). A recorder that dies while writing leaves such a line. It is skipped and is not an error.
class TakeReader {
 public:
  /// The result of next().
  enum class Got : std::uint8_t {
    head,         ///< time_code() and constants() are valid from now on
    params,       ///< params(): one video field
    skipped,      ///< a malformed line: fault(); only with MalformedLines::are_skipped
    truncated,    ///< the last line is truncated: fault(); the end follows
    end,          ///< every later call returns this, too
    nothing_yet,  ///< only for a FIFO with Waiting::never: fd() becomes readable when there is more
    failed,       ///< reading cannot continue: error()
  };

  /// Throws transport::TransportError: `PATH: cannot be read: REASON`; also if it is neither a regular file nor a FIFO.
  /// With Waiting::blocks, it waits for the writer of a FIFO.
  TakeReader(std::string path, MalformedLines malformed, Waiting waiting);

  [[nodiscard]] Got next();
  /// Goes back to the first field of a regular file, after next() has returned `head`, which is not returned again.
  /// False if the system call fails: error().
  [[nodiscard]] bool rewind();

  const base::TimeCode& time_code() const noexcept { return time_code_; }
  const wire::CameraConstants& constants() const noexcept { return constants_; }
  const wire::CameraParams& params() const noexcept { return params_; }
  /// Names the line; describe() gives "line 57: field 9 is not a number", "line 57 is truncated: field 9 is missing".
  const transport::Fault& fault() const noexcept { return fault_; }
  /// One line for users: `PATH:LINE: what is wrong`, or `PATH: cannot be read: REASON`.
  const std::string& error() const noexcept { return error_; }

  const std::string& path() const noexcept { return path_; }
  int fd() const noexcept { return file_.get(); }
  bool is_fifo() const noexcept { return is_fifo_; }
  /// The part of the file that has been read, 0 to 1; 0 for a FIFO.
  double progress() const noexcept;

 private:
  enum class Stage : std::uint8_t { magic, time_code, constants, params, ended, failed };
  enum class Line : std::uint8_t { whole, last, too_long, end, nothing_yet, failed };

  /// A position in the file, and the number of the line before it.
  struct Place {
    std::uint64_t offset = 0;
    std::uint32_t line = 0;
  };

  Line next_line(std::string_view& line);
  Line fill();
  Got take_head(std::string_view content);
  Got take_params(std::string_view content, bool is_last);
  Got malformed(std::uint8_t code, std::int16_t field);
  Got fail(const std::string& reason);
  Got finish();

  const std::string path_;
  const MalformedLines malformed_;
  const Waiting waiting_;
  transport::Descriptor file_;
  bool is_fifo_ = false;
  std::uint64_t size_ = 0;  // of a regular file, when it was opened
  // A disk block has many lines. A line that is too long is detected before the next block is read.
  std::array<char, 2 * wire::max_datagram> buffer_{};
  std::size_t begin_ = 0, end_ = 0;  // of the bytes that were read and not returned yet
  std::uint64_t read_ = 0;           // bytes of the file, up to end_
  bool at_end_ = false;              // of the file
  bool skips_ = false;               // skips the rest of a line that is too long
  std::uint32_t number_ = 0;         // of the line
  Stage stage_ = Stage::magic;
  Place first_field_;

  base::TimeCode time_code_;
  wire::CameraConstants constants_;
  wire::CameraParams params_;
  bool has_params_ = false;
  transport::Fault fault_;
  std::string error_;
};

}  // namespace trk_bridge::file
