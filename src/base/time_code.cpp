#include "trk_bridge/base/time_code.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace trk_bridge::base {
namespace {

struct Part {
  int TimeCode::*value;
  int least, most;
};

constexpr std::array<Part, 5> parts{{{&TimeCode::hours, 0, 23},
                                     {&TimeCode::minutes, 0, 59},
                                     {&TimeCode::seconds, 0, 59},
                                     {&TimeCode::frames, 0, 99},
                                     {&TimeCode::field, 1, 2}}};

bool parse_part(std::string_view digits, const Part& part, TimeCode& into) {
  if (digits.empty() || digits.size() > 2) return false;
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) return false;
  if (value < part.least || value > part.most) return false;
  into.*part.value = value;
  return true;
}

}  // namespace

tl::expected<TimeCode, std::string> parse_time_code(std::string_view text) {
  TimeCode code;
  std::string_view rest = text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_last = i + 1 == parts.size();
    const std::size_t colon = is_last ? rest.size() : rest.find(':');
    if (colon == std::string_view::npos || !parse_part(rest.substr(0, colon), parts[i], code)) {
      return tl::unexpected(
          "\"" + std::string(text.substr(0, 40)) +
          "\" is no time code: HH:MM:SS:FF:D with hours 0 to 23, minutes and seconds 0 to 59, frames and "
          "field 1 or 2");
    }
    rest.remove_prefix(is_last ? colon : colon + 1);
  }
  return code;
}

std::string to_string(const TimeCode& code) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%02d:%02d:%02d:%02d:%d", code.hours, code.minutes, code.seconds, code.frames,
                code.field);
  return text.data();
}

tl::expected<std::int64_t, std::string> nanoseconds_of(const TimeCode& code, double field_rate, std::uint64_t index) {
  const std::int64_t nominal = std::llround(field_rate);
  const std::int64_t field_of_second = 2 * static_cast<std::int64_t>(code.frames) + code.field - 1;
  if (field_of_second >= nominal) {
    return tl::unexpected("time code " + to_string(code) + " has a field that a second of " + std::to_string(nominal) +
                          " fields does not have");
  }
  const std::int64_t seconds = (code.hours * 60LL + code.minutes) * 60LL + code.seconds;
  const long double fields =
      static_cast<long double>(seconds * nominal + field_of_second) + static_cast<long double>(index);
  return static_cast<std::int64_t>(std::llround(fields * 1e9L / static_cast<long double>(field_rate)));
}

tl::expected<TimeCode, std::string> time_code_at(std::int64_t nanoseconds, double field_rate) {
  const auto refuse = [&](const std::string& why) {
    return tl::unexpected("no time code expresses " + std::to_string(nanoseconds) + " ns after midnight at " +
                          std::to_string(field_rate) + " fields a second: " + why);
  };
  if (nanoseconds < 0) return refuse("it is before midnight");
  if (!(field_rate >= 1 && field_rate <= 1e6)) return refuse("rates are 1 to 1000000 Hz");
  const std::int64_t nominal = std::llround(field_rate);
  const long double seconds_exact = static_cast<long double>(nanoseconds) / 1e9L;
  const std::int64_t fields = std::llround(seconds_exact * static_cast<long double>(field_rate));
  const std::int64_t seconds = fields / nominal % (std::int64_t{24} * 60 * 60);
  const std::int64_t frames = fields % nominal / 2;
  if (frames > parts[3].most) return refuse("frame " + std::to_string(frames) + " has more than two digits");
  const auto part = [](std::int64_t value) { return static_cast<int>(value); };
  return TimeCode{part(seconds / 3600), part(seconds / 60 % 60), part(seconds % 60), part(frames),
                  part(fields % nominal % 2 + 1)};
}

}  // namespace trk_bridge::base
