#include "take.h"

#include <array>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include "transport/socket.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {
namespace {

constexpr std::string_view white_space = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(white_space);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(white_space) - begin + 1);
}

std::string read_all(const std::string& path) {
  const auto fail = [&path](int error) {
    throw transport::TransportError(path + ": cannot be read: " + std::system_category().message(error));
  };
  const transport::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(errno);
  std::string text;
  std::vector<char> chunk(1 << 16);
  for (;;) {
    const ssize_t got = ::read(file.get(), chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(errno);
    if (got == 0) return text;
    text.append(chunk.data(), static_cast<std::size_t>(got));
  }
}

/// The lines that count, with their numbers.
class Lines {
 public:
  Lines(const std::string& path, std::string_view text) : path_(path), rest_(text) {}

  /// The next line that is neither blank nor a comment, without the white space around it.
  std::optional<std::string_view> next() {
    while (!rest_.empty()) {
      ++number_;
      const std::size_t end = rest_.find('\n');
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      if (line.size() >= wire::max_datagram) {
        fail("a line of " + std::to_string(line.size()) + " bytes: lines are shorter than " +
             std::to_string(wire::max_datagram));
      }
      const std::string_view content = trimmed(line);
      if (content.empty() || content.front() == '#') continue;
      if (content.find('\0') != std::string_view::npos) fail("a NUL byte in a line of text");
      return content;
    }
    return std::nullopt;
  }

  std::string_view require(const char* what) {
    if (const auto line = next()) return *line;
    ++number_;
    fail(std::string("the file ends where ") + what + " should stand");
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw transport::TransportError(path_ + ":" + std::to_string(number_) + ": " + reason);
  }

 private:
  const std::string& path_;
  std::string_view rest_;
  std::size_t number_ = 0;
};

tl::unexpected<transport::SinkFault> system_fault(int error) {
  transport::SinkFault fault{transport::SinkReason::system};
  fault.error_number = error;
  return tl::unexpected(fault);
}

tl::unexpected<transport::SinkFault> encode_fault(const wire::Fault& fault) {
  return tl::unexpected(transport::SinkFault{transport::SinkReason::not_encodable, fault});
}

}  // namespace

Take read_take(const std::string& path) {
  const std::string text = read_all(path);
  Lines lines(path, text);
  Take take;

  if (lines.require("DMC01") != "DMC01") lines.fail("not a take: it does not begin with a line DMC01");

  auto code = base::parse_time_code(lines.require("the time code of the first field"));
  if (!code) lines.fail(code.error());
  take.time_code = *code;

  const auto constants = wire::constants_from_text(lines.require("the camera's constants"));
  if (!constants) lines.fail("constants: " + wire::describe(constants.error()));
  take.constants = *constants;

  while (const auto line = lines.next()) {
    const auto params = wire::params_from_text(*line);
    if (!params) lines.fail(wire::describe(params.error()));
    take.params.push_back(*params);
  }
  return take;
}

TakeWriter::TakeWriter(std::string path, const base::TimeCode& time_code, bool overwrite)
    : file_(std::move(path), overwrite) {
  const auto written =
      append("DMC01\n# time code of the first field\n" + to_string(time_code) + "\n# constants of the camera");
  if (!written) {
    file_.discard();
    throw transport::TransportError(
        file_.part() + ": cannot be written: " + std::system_category().message(written.error().error_number));
  }
}

TakeWriter::~TakeWriter() { static_cast<void>(close()); }

tl::expected<void, transport::SinkFault> TakeWriter::write(const wire::CameraConstants& constants) {
  if (!file_.is_open()) return tl::unexpected(transport::SinkFault{transport::SinkReason::closed});
  if (constants_) {
    if (constants.id != constants_->id)
      return tl::unexpected(transport::SinkFault{transport::SinkReason::other_camera});
    constants_hold_ = *constants_ == constants;
    if (!constants_hold_) return tl::unexpected(transport::SinkFault{transport::SinkReason::constants_changed});
    return {};
  }
  const auto text = wire::to_text(constants, buffer_);
  if (!text) return encode_fault(text.error());
  if (auto written = append(*text); !written) return written;
  constants_ = constants;
  constants_hold_ = true;
  return {};
}

tl::expected<void, transport::SinkFault> TakeWriter::write(const wire::CameraParams& params) {
  if (!file_.is_open()) return tl::unexpected(transport::SinkFault{transport::SinkReason::closed});
  if (!constants_) return tl::unexpected(transport::SinkFault{transport::SinkReason::no_constants});
  const std::uint32_t any = constants_->id == 0 ? params.id : constants_->id;
  if (params.id != camera_.value_or(any))
    return tl::unexpected(transport::SinkFault{transport::SinkReason::other_camera});
  if (!constants_hold_) return tl::unexpected(transport::SinkFault{transport::SinkReason::constants_changed});
  const auto text = wire::to_text(params, buffer_);
  if (!text) return encode_fault(text.error());
  auto written = append(*text);
  if (written) camera_ = params.id;
  return written;
}

tl::expected<void, transport::SinkFault> TakeWriter::append(std::string_view line) {
  std::array<iovec, 2> pieces{};
  std::size_t done = 0;
  const std::size_t length = line.size() + 1;
  char newline = '\n';
  while (done < length) {
    const std::size_t of_line = done < line.size() ? line.size() - done : 0;
    pieces[0] = {const_cast<char*>(line.data()) + (line.size() - of_line), of_line};
    pieces[1] = {&newline, 1};
    const ssize_t written = ::pwritev(file_.fd(), pieces.data(), static_cast<int>(pieces.size()),
                                      static_cast<off_t>(size_ + static_cast<std::int64_t>(done)));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return system_fault(written < 0 ? errno : EIO);
    done += static_cast<std::size_t>(written);
  }
  size_ += static_cast<std::int64_t>(length);
  return {};
}

tl::expected<void, transport::SinkFault> TakeWriter::close() {
  if (!file_.is_open()) return {};
  if (!constants_) {
    file_.discard();
    return tl::unexpected(transport::SinkFault{transport::SinkReason::no_constants});
  }
  // A write that failed half-way has left its beginning behind the last whole line.
  if (const auto published = file_.publish(size_); !published) return system_fault(published.error());
  return {};
}

}  // namespace trk_bridge::file
