// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "take_writer.h"

#include <cerrno>
#include <utility>

#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {
namespace {

using transport::refused;
using transport::refused_by_system;
using transport::SinkFault;
using transport::SinkReason;
using transport::WriteResult;

tl::unexpected<SinkFault> encode_fault(const wire::Fault& of_record) {
  return tl::unexpected(SinkFault{SinkReason::not_encodable, of_record});
}

}  // namespace

OpenedFile open_take(const std::string& path, bool overwrite) {
  static_cast<void>(recover_part(path + ".part"));
  return PartFile::open(path, {overwrite, Fifo::allowed});
}

TakeWriter::TakeWriter() { line_.reserve(2 * wire::max_datagram); }

TakeWriter::TakeWriter(const std::string& path, const base::TimeCode& time_code, bool overwrite) : TakeWriter() {
  time_code_ = time_code;
  auto file = open_take(path, overwrite);
  const WriteResult opened = file ? open(*std::move(file)) : WriteResult(tl::unexpected(file.error()));
  if (!opened) throw transport::TransportError(path + ": cannot be written: " + transport::describe(opened.error()));
}

TakeWriter::~TakeWriter() { static_cast<void>(close()); }

WriteResult TakeWriter::open(PartFile file) {
  file_ = std::move(file);
  size_ = 0;
  has_fields_ = false;
  // WriteResult now, so that a full disk is detected before the first field.
  auto begun = append("DMC01\n");
  if (!begun) file_.discard();
  return begun;
}

tl::expected<std::string, SinkFault> TakeWriter::head() {
  const auto text = wire::to_text(*constants_, buffer_);
  if (!text) return encode_fault(text.error());
  return "# time code of the first field\n" + to_string(time_code_) + "\n# constants of the camera\n" +
         std::string(*text) + "\n";
}

WriteResult TakeWriter::write(const wire::CameraConstants& constants) {
  if (ended_) return refused(SinkReason::closed);
  if (constants_ && constants.id != constants_->id) return refused(SinkReason::other_camera);
  if (has_fields_) {
    constants_hold_ = *constants_ == constants;
    if (!constants_hold_) return refused(SinkReason::constants_changed);
    return {};
  }
  if (const auto text = wire::to_text(constants, buffer_); !text) return encode_fault(text.error());
  constants_ = constants;
  constants_hold_ = true;
  return {};
}

WriteResult TakeWriter::write(const wire::CameraParams& params) {
  if (!is_open()) return refused(SinkReason::closed);
  if (!constants_) return refused(SinkReason::no_constants);
  const std::uint32_t any = constants_->id == 0 ? params.id : constants_->id;
  if (params.id != camera_.value_or(any)) return refused(SinkReason::other_camera);
  if (!constants_hold_) return refused(SinkReason::constants_changed);
  line_.clear();
  if (!has_fields_) {
    const auto before = head();
    if (!before) return tl::unexpected(before.error());
    line_ += *before;
  }
  const auto text = wire::to_text(params, buffer_);
  if (!text) return encode_fault(text.error());
  line_ += *text;
  line_ += '\n';
  auto written = append(line_);
  if (!written) return written;
  camera_ = params.id;
  has_fields_ = true;
  return {};
}

WriteResult TakeWriter::append(std::string_view lines) {
  if (const auto written = file_.write(lines, size_); !written) {
    if (file_.is_fifo()) {
      file_.discard();
      has_fields_ = false;
    }
    return written.error() == EPIPE ? refused(SinkReason::no_reader) : refused_by_system(written.error());
  }
  size_ += static_cast<std::int64_t>(lines.size());
  return {};
}

WriteResult TakeWriter::close() {
  ended_ = true;
  if (!is_open()) return {};
  const auto closed = finish();
  // If it was not published, the `.part` remains.
  file_ = {};
  return closed;
}

WriteResult TakeWriter::finish() {
  if (!constants_) {
    file_.discard();
    return refused(SinkReason::no_constants);
  }
  if (!has_fields_) {
    const auto before = head();
    if (!before) return tl::unexpected(before.error());
    if (auto written = append(*before); !written) return written;
  }
  // Truncates after the last complete line, because a failed write may have left part of a line.
  if (const auto published = file_.publish(size_); !published) return refused_by_system(published.error());
  return {};
}

void TakeWriter::discard() noexcept {
  ended_ = true;
  file_.discard();
}

}  // namespace trk_bridge::file
