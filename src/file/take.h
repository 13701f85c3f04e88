// A take: the text file of one camera's parameters, one set a video field (doc/wire_formats.md, "File").
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

/// What to do with a line of parameters that is not sound.
enum class MalformedLines : std::uint8_t { are_errors, are_skipped };

/// Whether a reader of a FIFO waits for its writer.
enum class Waiting : std::uint8_t { blocks, never };

/// Reads a take line by line as it is asked for, in memory of a fixed size, whatever its length and that of its lines:
/// a line of 4096 bytes or more is not sound. What is wrong with a line is known when next() comes to it. Lines may end
/// in LF or CRLF, and a byte order mark of UTF-8 may stand in front. One thread at a time.
///
/// A last line without its end is *cut* when it is not sound, or when its counter, of which digits may be missing, is
/// below the one before: what a recorder leaves that died while writing. It is left out, and no error.
class TakeReader {
 public:
  /// What next() met.
  enum class Got : std::uint8_t {
    head,         ///< time_code() and constants() are known, and only now
    params,       ///< params(): one video field
    skipped,      ///< a line that is not sound: fault(); only with MalformedLines::are_skipped
    truncated,    ///< the last line is: fault(); the end follows
    end,          ///< and nothing else from then on
    nothing_yet,  ///< of a FIFO, only with Waiting::never: fd() is readable when there is more
    failed,       ///< it cannot be read on: error()
  };

  /// Throws transport::TransportError: `PATH: cannot be read: why`; also for what is neither a regular file nor a FIFO.
  /// With Waiting::blocks it waits for a FIFO's writer.
  TakeReader(std::string path, MalformedLines malformed, Waiting waiting);

  [[nodiscard]] Got next();
  /// Goes back to the first field of a regular file, once next() has said `head`; no further `head` comes. False when
  /// the system refuses: error().
  [[nodiscard]] bool rewind();

  const base::TimeCode& time_code() const noexcept { return time_code_; }
  const wire::CameraConstants& constants() const noexcept { return constants_; }
  const wire::CameraParams& params() const noexcept { return params_; }
  /// Names the line; describe(): "line 57: field 9 is not a number", "line 57 is truncated: field 9 is missing".
  const transport::Fault& fault() const noexcept { return fault_; }
  /// One line for a person: `PATH:LINE: what is wrong`, or `PATH: cannot be read: why`.
  const std::string& error() const noexcept { return error_; }

  const std::string& path() const noexcept { return path_; }
  int fd() const noexcept { return file_.get(); }
  bool is_fifo() const noexcept { return is_fifo_; }
  /// How much of the file has been read, 0 to 1; of a FIFO 0.
  double progress() const noexcept;

 private:
  enum class Stage : std::uint8_t { magic, time_code, constants, params, ended, failed };
  enum class Line : std::uint8_t { whole, last, too_long, end, nothing_yet, failed };

  /// Where a file is read on, and what the next line's number is less one.
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
  std::uint64_t size_ = 0;  // of a regular file when it was opened
  // A block of a disk holds many lines. One that is too long is seen before the next block is read.
  std::array<char, 2 * wire::max_datagram> buffer_{};
  std::size_t begin_ = 0, end_ = 0;  // of what is read and not handed out
  std::uint64_t read_ = 0;           // of the file, up to end_
  bool at_end_ = false;              // of the file
  bool skips_ = false;               // the rest of a line that is too long
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
