// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "take.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/system_text.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_white(char c) { return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n'); }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_white(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_white(text.back())) text.remove_suffix(1);
  return text;
}

// Fault codes of text in addition to those of wire::Reason.
constexpr std::uint8_t has_nul = 200, is_too_long = 201, is_out_of_order = 202;

std::string reason_text(std::uint8_t code, std::int16_t field) {
  switch (code) {
    case has_nul:
      return "a NUL byte in a line of text";
    case is_too_long:
      return "a line of " + std::to_string(wire::max_datagram) + " bytes or more: lines are shorter than " +
             std::to_string(wire::max_datagram);
    case is_out_of_order:
      return "its counter is lower than the previous one";
    default:
      wire::Fault fault{static_cast<wire::Reason>(code)};
      fault.about_field = field >= 0;
      if (fault.about_field) fault.field = static_cast<std::uint8_t>(field);
      return wire::describe(fault);
  }
}

std::string describe_malformed(const transport::Fault& fault) {
  return "line " + std::to_string(fault.line()) + ": " + reason_text(fault.code(), fault.field());
}

std::string describe_truncated(const transport::Fault& fault) {
  return "line " + std::to_string(fault.line()) + " is truncated: " + reason_text(fault.code(), fault.field()) +
         "; all lines before it are used";
}

std::string refusal(const std::string& path, const std::string& reason) { return path + ": cannot be read: " + reason; }

/// Empty if the kind of file can be read.
std::string refusal_of_kind(mode_t mode) {
  if (S_ISREG(mode) || S_ISFIFO(mode)) return {};
  if (S_ISDIR(mode)) return base::system_text(EISDIR);
  const char* const kind = S_ISCHR(mode) || S_ISBLK(mode) ? "a device" : S_ISSOCK(mode) ? "a socket" : "something else";
  return std::string("it is ") + kind + "; allowed are regular files and FIFOs";
}

}  // namespace

TakeReader::TakeReader(std::string path, MalformedLines malformed, Waiting waiting)
    : path_(std::move(path)), malformed_(malformed), waiting_(waiting), file_(-1) {
  const auto refuse = [this](const std::string& reason) { throw transport::TransportError(refusal(path_, reason)); };
  // Checked before it is opened: opening a device can have side effects.
  struct stat state {};
  if (::stat(path_.c_str(), &state) != 0) refuse(base::system_text(errno));
  if (const std::string reason = refusal_of_kind(state.st_mode); !reason.empty()) refuse(reason);
  const int flags = waiting == Waiting::never ? O_RDONLY | O_CLOEXEC | O_NONBLOCK : O_RDONLY | O_CLOEXEC;
  file_ = transport::Descriptor(::open(path_.c_str(), flags | O_NOCTTY));
  if (file_.get() < 0 || ::fstat(file_.get(), &state) != 0) refuse(base::system_text(errno));
  if (const std::string reason = refusal_of_kind(state.st_mode); !reason.empty()) refuse(reason);
  is_fifo_ = S_ISFIFO(state.st_mode);
  if (!is_fifo_) size_ = static_cast<std::uint64_t>(state.st_size);
}

double TakeReader::progress() const noexcept {
  if (size_ == 0) return 0;
  return std::min(1.0, static_cast<double>(read_) / static_cast<double>(size_));
}

bool TakeReader::rewind() {
  if (::lseek(file_.get(), static_cast<off_t>(first_field_.offset), SEEK_SET) < 0) {
    error_ = refusal(path_, base::system_text(errno));
    stage_ = Stage::failed;
    return false;
  }
  begin_ = end_ = 0;
  read_ = first_field_.offset;
  number_ = first_field_.line;
  at_end_ = skips_ = has_params_ = false;
  stage_ = Stage::params;
  return true;
}

TakeReader::Line TakeReader::fill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  for (;;) {
    if (is_fifo_ && waiting_ == Waiting::never) {
      // While there is no writer, read() would report the end of the file.
      pollfd more{file_.get(), POLLIN, 0};
      if (::poll(&more, 1, 0) == 0) return Line::nothing_yet;
    }
    const ssize_t got = ::read(file_.get(), buffer_.data() + end_, buffer_.size() - end_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return Line::nothing_yet;
    if (got < 0) return Line::failed;
    if (got == 0) at_end_ = true;
    end_ += static_cast<std::size_t>(got);
    read_ += static_cast<std::uint64_t>(got);
    return Line::whole;
  }
}

TakeReader::Line TakeReader::next_line(std::string_view& line) {
  for (;;) {
    const std::string_view read(buffer_.data() + begin_, end_ - begin_);
    const std::string_view searched = skips_ ? read : read.substr(0, wire::max_datagram);
    const std::size_t length = searched.find('\n');
    if (length != std::string_view::npos) {
      begin_ += length + 1;
      if (std::exchange(skips_, false)) continue;
      ++number_;
      line = read.substr(0, length);
      return Line::whole;
    }
    if (skips_) begin_ = end_;
    if (!skips_ && searched.size() == wire::max_datagram) {
      ++number_;
      skips_ = true;
      return Line::too_long;
    }
    if (at_end_) {
      if (begin_ == end_) return Line::end;
      begin_ = end_;
      ++number_;
      line = read;
      return Line::last;
    }
    if (const Line filled = fill(); filled != Line::whole) return filled;
  }
}

TakeReader::Got TakeReader::next() {
  if (stage_ == Stage::failed) return Got::failed;
  for (;;) {
    if (stage_ == Stage::ended) return Got::end;
    std::string_view line;
    const Line got = next_line(line);
    switch (got) {
      case Line::nothing_yet:
        return Got::nothing_yet;
      case Line::failed:
        error_ = refusal(path_, base::system_text(errno));
        stage_ = Stage::failed;
        return Got::failed;
      case Line::end:
        return finish();
      case Line::too_long:
        return malformed(is_too_long, -1);
      case Line::whole:
      case Line::last:
        break;
    }
    if (number_ == 1 && line.substr(0, byte_order_mark.size()) == byte_order_mark) {
      line.remove_prefix(byte_order_mark.size());
    }
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    if (stage_ == Stage::params) return take_params(content, got == Line::last);
    if (const Got head = take_head(content); head != Got::nothing_yet) return head;
  }
}

/// nothing_yet: the head continues in the next line.
TakeReader::Got TakeReader::take_head(std::string_view content) {
  if (content.find('\0') != std::string_view::npos) return fail(reason_text(has_nul, -1));
  if (stage_ == Stage::magic) {
    if (content != "DMC01") return fail("not a take: it does not begin with a line DMC01");
    stage_ = Stage::time_code;
    return Got::nothing_yet;
  }
  if (stage_ == Stage::time_code) {
    const auto code = base::parse_time_code(content);
    if (!code) return fail(code.error());
    time_code_ = *code;
    stage_ = Stage::constants;
    return Got::nothing_yet;
  }
  const auto constants = wire::constants_from_text(content);
  if (!constants) return fail("constants: " + wire::describe(constants.error()));
  constants_ = *constants;
  stage_ = Stage::params;
  first_field_ = {read_ - (end_ - begin_), number_};
  return Got::head;
}

TakeReader::Got TakeReader::take_params(std::string_view content, bool is_last) {
  const auto give_up = [&](std::uint8_t code, std::int16_t field) {
    if (!is_last) return malformed(code, field);
    fault_ = {"truncated line", describe_truncated, code, field, number_};
    return Got::truncated;
  };
  if (content.find('\0') != std::string_view::npos) return give_up(has_nul, -1);
  const auto params = wire::params_from_text(content);
  if (!params) {
    const transport::Fault fault = params.error();
    return give_up(fault.code(), fault.field());
  }
  if (is_last && has_params_ && params->counter < params_.counter) return give_up(is_out_of_order, -1);
  params_ = *params;
  has_params_ = true;
  return Got::params;
}

TakeReader::Got TakeReader::malformed(std::uint8_t code, std::int16_t field) {
  if (stage_ != Stage::params || malformed_ == MalformedLines::are_errors) return fail(reason_text(code, field));
  fault_ = {"malformed line", describe_malformed, code, field, number_};
  return Got::skipped;
}

TakeReader::Got TakeReader::fail(const std::string& reason) {
  error_ = path_ + ":" + std::to_string(number_) + ": " + reason;
  stage_ = Stage::failed;
  return Got::failed;
}

TakeReader::Got TakeReader::finish() {
  const char* const missing = stage_ == Stage::magic       ? "DMC01"
                              : stage_ == Stage::time_code ? "the time code of the first field"
                              : stage_ == Stage::constants ? "the camera's constants"
                                                           : nullptr;
  if (missing != nullptr) {
    ++number_;
    return fail(std::string("the file ends before ") + missing);
  }
  stage_ = Stage::ended;
  return Got::end;
}

}  // namespace trk_bridge::file
