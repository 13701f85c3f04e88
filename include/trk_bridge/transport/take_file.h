// A take: the text file of one camera's parameters, one set a video field (wire format, "File").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "trk_bridge/transport/part_file.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::transport {

/// HH:MM:SS:FF:D, non-drop. A second nominally has round(field rate) fields and a frame two of them.
struct TimeCode {
  int hours = 0, minutes = 0, seconds = 0;
  int frames = 0;  ///< from 0
  int field = 1;   ///< 1 or 2
};
inline bool operator==(const TimeCode& a, const TimeCode& b) noexcept {
  return a.hours == b.hours && a.minutes == b.minutes && a.seconds == b.seconds && a.frames == b.frames &&
         a.field == b.field;
}
inline bool operator!=(const TimeCode& a, const TimeCode& b) noexcept { return !(a == b); }

/// One or two digits each. The error names the text and what is allowed. Frames may be up to 99 here, for only a field
/// rate tells how many there are: nanoseconds_of() checks that.
tl::expected<TimeCode, std::string> parse_time_code(std::string_view);
/// Two digits each, one for the field: "10:20:30:12:1".
std::string to_string(const TimeCode&);
/// Nanoseconds after midnight of the field `index` fields after the code: the nominal count of fields since midnight
/// over `field_rate` (Hz, more than 0). Beyond 24 hours it goes on rising. An error when the code has a frame or a
/// field that a second of this rate does not have.
tl::expected<std::int64_t, std::string> nanoseconds_of(const TimeCode&, double field_rate, std::uint64_t index);

/// The way back: the code of the field nearest to a time after midnight (ns, not negative); after 23:59:59 the day's
/// codes begin anew. An error for rates outside of 1 to 1e6 Hz and for a frame above 99, which a code cannot tell.
tl::expected<TimeCode, std::string> time_code_at(std::int64_t nanoseconds, double field_rate);

/// A whole take in memory.
struct Take {
  TimeCode time_code;
  wire::CameraConstants constants;
  std::vector<wire::CameraParams> params;  ///< may be empty: a recording that ended before its first field
};

/// Reads a whole take; lines may end in LF or CRLF. Throws TransportError: `PATH:LINE: what is wrong`, or
/// `PATH: why it cannot be read`.
Take read_take(const std::string& path);

/// Writes a take line by line into `PATH.part`, which gets its final name only when it is whole. A writer that dies
/// leaves nothing under the final name, and every field it wrote in `PATH.part`. One thread at a time; writing does not
/// allocate.
class TakeWriter {
 public:
  /// Throws TransportError, as PartFile does.
  TakeWriter(std::string path, const TimeCode&, bool overwrite);
  /// As close(), but cannot say how it went.
  ~TakeWriter();
  TakeWriter(const TakeWriter&) = delete;
  TakeWriter& operator=(const TakeWriter&) = delete;

  /// Once, before the first parameters. The same again is no fault and writes nothing. Others of that id are
  /// constants_changed, as are all parameters until the first ones come again; other ids are other_camera.
  [[nodiscard]] tl::expected<void, SinkFault> write(const wire::CameraConstants&);
  /// One video field, of the constants' id; constants with id 0 serve any camera, the first one's id counting from then
  /// on. no_constants before the constants. A line that could not be written whole is not in the file.
  [[nodiscard]] tl::expected<void, SinkFault> write(const wire::CameraParams&);
  /// Brings everything to the disk and gives the file its final name. Without constants there is no take: no_constants,
  /// and nothing stays. When the system refuses, `PATH.part` stays as it is. Closing again does nothing.
  [[nodiscard]] tl::expected<void, SinkFault> close();

  /// Ends it without a trace, for a take that turned out to be of no use.
  void discard() noexcept { file_.discard(); }

  const std::string& path() const noexcept { return file_.path(); }

 private:
  tl::expected<void, SinkFault> append(std::string_view line);

  PartFile file_;
  std::int64_t size_ = 0;  // of the whole lines; what lies behind is what is left of a failed write
  std::optional<wire::CameraConstants> constants_;
  std::optional<std::uint32_t> camera_;  // of the parameters written
  bool constants_count_ = false;         // no others have come since
  wire::Buffer buffer_{};
};

}  // namespace trk_bridge::transport
