// Writing a take line by line (doc/wire_formats.md, "File").
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "part_file.h"
#include "trk_bridge/base/time_code.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::file {

/// Writes a take line by line into `PATH.part`, which gets its final name only when it is whole. A writer that dies
/// leaves nothing under the final name, and every field it wrote in `PATH.part`. One thread at a time; writing does not
/// allocate.
class TakeWriter {
 public:
  /// Throws transport::TransportError, as PartFile does.
  TakeWriter(std::string path, const base::TimeCode&, bool overwrite);
  /// As close(), but cannot say how it went.
  ~TakeWriter();
  TakeWriter(const TakeWriter&) = delete;
  TakeWriter& operator=(const TakeWriter&) = delete;

  /// Once, before the first parameters. The same again is no fault and writes nothing. Others of that id are
  /// constants_changed, as are all parameters until the first ones come again; other ids are other_camera.
  [[nodiscard]] tl::expected<void, transport::SinkFault> write(const wire::CameraConstants&);
  /// One video field, of the constants' id; constants with id 0 serve any camera, the first one's id counting from then
  /// on. no_constants before the constants. A line that could not be written whole is not in the file.
  [[nodiscard]] tl::expected<void, transport::SinkFault> write(const wire::CameraParams&);
  /// Brings everything to the disk and gives the file its final name. Without constants there is no take: no_constants,
  /// and nothing stays. When the system refuses, `PATH.part` stays as it is. Closing again does nothing.
  [[nodiscard]] tl::expected<void, transport::SinkFault> close();

  /// Ends it without a trace, for a take that turned out to be of no use.
  void discard() noexcept { file_.discard(); }

  const std::string& path() const noexcept { return file_.path(); }

 private:
  tl::expected<void, transport::SinkFault> append(std::string_view line);

  PartFile file_;
  std::int64_t size_ = 0;  // of the whole lines; what lies behind is what is left of a failed write
  std::optional<wire::CameraConstants> constants_;
  std::optional<std::uint32_t> camera_;  // of the parameters written
  bool constants_hold_ = false;          // no others have come since
  wire::Buffer buffer_{};
};

}  // namespace trk_bridge::file
