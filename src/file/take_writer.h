// Writing a take, line by line.
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

/// The file, or why there is none.
using OpenedFile = tl::expected<PartFile, transport::SinkFault>;
/// For a take of that name. What a dead writer left of one before is published first (recover_part).
OpenedFile open_take(const std::string& path, bool overwrite);

/// Writes a take into `PATH.part`, which gets its final name only when it is whole. Every line is one write: of a
/// writer that is killed, all lines up to the last whole one are in `PATH.part`. The lines before the first field are
/// written together with it, so that until then the time code and the constants may still change. One thread at a time;
/// writing allocates nothing but for the first field.
class TakeWriter {
 public:
  /// Without a file: takes constants, and says `closed` to parameters.
  TakeWriter();
  /// With the file open. Throws transport::TransportError.
  TakeWriter(const std::string& path, const base::TimeCode&, bool overwrite);
  /// As close(), but cannot say how it went.
  ~TakeWriter();
  TakeWriter(const TakeWriter&) = delete;
  TakeWriter& operator=(const TakeWriter&) = delete;

  /// Begins a take in this file. Where that fails, nothing stays of it.
  [[nodiscard]] transport::Written open(PartFile);
  bool is_open() const noexcept { return file_.is_open(); }
  /// Of the first field: counts while there is none.
  void set_time_code(const base::TimeCode& code) noexcept { time_code_ = code; }
  bool has_constants() const noexcept { return constants_.has_value(); }
  bool has_fields() const noexcept { return has_fields_; }

  /// Before the first parameters; until then, newer ones of the same id take the place of older ones. After them the
  /// same again is no fault and writes nothing, others of that id are constants_changed, as are all parameters until
  /// the first ones come again. Other ids are other_camera.
  [[nodiscard]] transport::Written write(const wire::CameraConstants&);
  /// One video field, of the constants' id; constants with id 0 serve any camera, the first one's id counting from then
  /// on. no_constants before the constants. A line that could not be written whole is not in the file. A FIFO that has
  /// lost its reader is closed.
  [[nodiscard]] transport::Written write(const wire::CameraParams&);
  /// Brings everything to the disk and gives the file its final name. Without constants there is no take: no_constants,
  /// and nothing stays. When the system refuses, `PATH.part` stays as it is. Closing again does nothing.
  [[nodiscard]] transport::Written close();

  /// Ends it without a trace, for a take that turned out to be of no use.
  void discard() noexcept;

  const std::string& path() const noexcept { return file_.path(); }

 private:
  /// The lines between the first one and the fields.
  tl::expected<std::string, transport::SinkFault> head();
  transport::Written append(std::string_view lines);
  transport::Written finish();

  PartFile file_;
  base::TimeCode time_code_;
  std::int64_t size_ = 0;  // of the whole lines; what lies behind is what is left of a failed write
  std::optional<wire::CameraConstants> constants_;
  std::optional<std::uint32_t> camera_;  // of the parameters written
  bool constants_hold_ = false;          // no others have come since
  bool has_fields_ = false;
  bool ended_ = false;
  wire::Buffer buffer_{};
  std::string line_;
};

}  // namespace trk_bridge::file
