// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Writes a take, line by line.
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

/// The file, or the reason why it cannot be opened.
using OpenedFile = tl::expected<PartFile, transport::SinkFault>;
/// Opens a take of that name. First publishes the unfinished take of a dead writer (recover_part).
OpenedFile open_take(const std::string& path, bool overwrite);

/// Writes a take to `PATH.part`, which gets its final name only when it is complete. Every line is one write: if the
/// writer is killed, all lines up to the last complete one are in `PATH.part`. The lines before the first field are
/// written together with it, so that the time code and the constants may change until then. One thread at a time; only
/// writing the first field allocates.
class TakeWriter {
 public:
  /// Without a file: accepts constants, and refuses parameters with `closed`.
  TakeWriter();
  /// Opens the file. Throws transport::TransportError.
  TakeWriter(const std::string& path, const base::TimeCode&, bool overwrite);
  /// As close(), but cannot report errors.
  ~TakeWriter();
  TakeWriter(const TakeWriter&) = delete;
  TakeWriter& operator=(const TakeWriter&) = delete;

  /// Begins a take in this file. If that fails, the file is deleted.
  [[nodiscard]] transport::WriteResult open(PartFile);
  bool is_open() const noexcept { return file_.is_open(); }
  /// The time code of the first field. No effect after that field.
  void set_time_code(const base::TimeCode& code) noexcept { time_code_ = code; }
  bool has_constants() const noexcept { return constants_.has_value(); }
  bool has_fields() const noexcept { return has_fields_; }

  /// Constants come before the first parameters; until then, newer ones of the same id replace older ones. Afterwards,
  /// equal ones are accepted and write nothing. Different ones of that id are a constants_changed fault, as are all
  /// parameters until the first constants come again. Other ids are other_camera.
  [[nodiscard]] transport::WriteResult write(const wire::CameraConstants&);
  /// Writes one video field; its id must be that of the constants. If that is 0, the id of the first field is used from
  /// then on. no_constants before the constants. A line that could not be written completely is not in the file. A FIFO
  /// that has lost its reader is closed.
  [[nodiscard]] transport::WriteResult write(const wire::CameraParams&);
  /// Syncs the file to the disk and gives it its final name. Without constants, the result is no_constants and the file
  /// is deleted. If a system call fails, `PATH.part` remains. Closing again does nothing.
  [[nodiscard]] transport::WriteResult close();

  /// Ends and deletes a take that is not wanted.
  void discard() noexcept;

  const std::string& path() const noexcept { return file_.path(); }

 private:
  /// The lines between the first line and the fields.
  tl::expected<std::string, transport::SinkFault> head();
  transport::WriteResult append(std::string_view lines);
  transport::WriteResult finish();

  PartFile file_;
  base::TimeCode time_code_;
  std::int64_t size_ = 0;  // of the complete lines; bytes after them are the rest of a failed write
  std::optional<wire::CameraConstants> constants_;
  std::optional<std::uint32_t> camera_;  // the id of the parameters written
  bool constants_hold_ = false;          // no other constants have come since
  bool has_fields_ = false;
  bool ended_ = false;
  wire::Buffer buffer_{};
  std::string line_;
};

}  // namespace trk_bridge::file
