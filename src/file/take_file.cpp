#include "take_file.h"

#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "transport/descriptor.h"
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

}  // namespace trk_bridge::file
