#include "start_time.h"

#include <charconv>
#include <string_view>
#include <variant>

#include "trk_bridge/transport/endpoint.h"

namespace trk_bridge::tools {
namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t latest = 0xFFFFFFFF;  // s, of ROS times
constexpr std::size_t digits_of_fraction = 9;

/// All of `digits`, a number from 0 to `most`.
bool parse_whole(std::string_view digits, std::int64_t most, std::int64_t& into) {
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), into);
  return error == std::errc{} && end == digits.data() + digits.size() && digits.front() != '-' && into <= most;
}

/// "30" or "30.25" in nanoseconds.
bool parse_seconds(std::string_view text, std::int64_t most, std::int64_t& into) {
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  std::string fraction(point == std::string_view::npos ? "0" : text.substr(point + 1));
  if (whole.empty() || fraction.empty() || fraction.size() > digits_of_fraction) return false;
  fraction.resize(digits_of_fraction, '0');
  std::int64_t seconds = 0;
  std::int64_t nanoseconds = 0;
  if (!parse_whole(whole, most, seconds) || !parse_whole(fraction, second, nanoseconds)) return false;
  into = seconds * second + nanoseconds;
  return true;
}

/// "10:20:30.5" in nanoseconds.
bool parse_clock(std::string_view text, std::int64_t& into) {
  if (text.size() < 8 || text[2] != ':' || text[5] != ':') return false;
  std::int64_t hours = 0;
  std::int64_t minutes = 0;
  std::int64_t rest = 0;
  if (!parse_whole(text.substr(0, 2), 23, hours) || !parse_whole(text.substr(3, 2), 59, minutes)) return false;
  if (!parse_seconds(text.substr(6), 59, rest)) return false;
  into = (hours * 60 + minutes) * 60 * second + rest;
  return true;
}

}  // namespace

tl::expected<std::int64_t, std::string> parse_date(const std::string& text) {
  // Endpoints have dates, too, and one way of reading them is enough.
  const bool is_plain = text.find_first_not_of("0123456789-") == std::string::npos;
  const auto endpoint = transport::parse_endpoint("file:take?date=" + text, transport::Direction::read);
  const auto* file = endpoint ? std::get_if<transport::FileEndpoint>(&*endpoint) : nullptr;
  if (!is_plain || file == nullptr || !file->date) {
    return tl::unexpected("\"" + text + "\" is no date: YYYY-MM-DD");
  }
  if (*file->date < 0 || *file->date > latest)
    return tl::unexpected("\"" + text + "\": dates are 1970-01-01 to 2106-02-06");
  return *file->date * second;
}

tl::expected<std::int64_t, std::string> parse_moment(const std::string& text) {
  std::int64_t moment = 0;
  const std::size_t t = text.find('T');
  bool is_good = false;
  if (t == std::string::npos) {
    is_good = parse_seconds(text, latest, moment);
  } else {
    std::string_view clock = std::string_view(text).substr(t + 1);
    if (!clock.empty() && clock.back() == 'Z') clock.remove_suffix(1);
    const auto date = parse_date(text.substr(0, t));
    is_good = date && parse_clock(clock, moment);
    if (is_good) moment += *date;
  }
  if (!is_good || moment <= 0) {
    return tl::unexpected("\"" + text +
                          "\" is no time: YYYY-MM-DDTHH:MM:SS in UTC, or seconds since 1970, with up to 9 decimals, "
                          "after 1970-01-01 and before 2106");
  }
  return moment;
}

}  // namespace trk_bridge::tools
