// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "time_text.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <ctime>

namespace trk_bridge::base {
namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t latest = 0xFFFFFFFF;  // s, of ROS times: within 2106-02-07
constexpr std::int64_t seconds_of_day = 86'400;
constexpr std::size_t digits_of_fraction = 9;

/// Parses all of `digits` as a number from 0 to `most`.
template <typename Number>
bool parse_whole(std::string_view digits, Number most, Number& into) {
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
  const bool is_good = parse_whole(text.substr(0, 2), std::int64_t{23}, hours) &&
                       parse_whole(text.substr(3, 2), std::int64_t{59}, minutes) &&
                       parse_seconds(text.substr(6), 59, rest);
  into = (hours * 60 + minutes) * 60 * second + rest;
  return is_good;
}

}  // namespace

std::optional<std::int64_t> day_from_text(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  int year = 0;
  int month = 0;
  int day = 0;
  const bool is_good = parse_whole(text.substr(0, 4), 9999, year) && parse_whole(text.substr(5, 2), 12, month) &&
                       parse_whole(text.substr(8, 2), 31, day) && year >= 1970 && month >= 1 && day >= 1;
  if (!is_good) return std::nullopt;
  std::tm date{};
  date.tm_year = year - 1900;
  date.tm_mon = month - 1;
  date.tm_mday = day;
  const std::time_t seconds = ::timegm(&date);
  // timegm turns 30 February into 1 or 2 March.
  if (date.tm_mon != month - 1) return std::nullopt;
  return seconds;
}

tl::expected<std::int64_t, std::string> parse_date(const std::string& text) {
  const auto midnight = day_from_text(text);
  if (!midnight) return tl::unexpected("\"" + text + "\" is not a date: YYYY-MM-DD");
  // ROS times end within the last day.
  if (*midnight + seconds_of_day - 1 > latest)
    return tl::unexpected("\"" + text + "\": dates are 1970-01-01 to 2106-02-06");
  return *midnight * second;
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
    const auto midnight = day_from_text(std::string_view(text).substr(0, t));
    is_good = midnight && *midnight <= latest && parse_clock(clock, moment);
    if (is_good) moment += *midnight * second;
  }
  if (!is_good || moment <= 0 || moment / second > latest) {
    return tl::unexpected("\"" + text +
                          "\" is not a time: YYYY-MM-DDTHH:MM:SS in UTC, or seconds since 1970, with up to 9 decimals, "
                          "after 1970-01-01T00:00:00 and up to 2106-02-07T06:28:15");
  }
  return moment;
}

std::string seconds_text(std::int64_t nanoseconds) {
  const bool is_negative = nanoseconds < 0;
  const auto size = is_negative ? -static_cast<std::uint64_t>(nanoseconds) : static_cast<std::uint64_t>(nanoseconds);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%s%llu.%09llu", is_negative ? "-" : "",
                static_cast<unsigned long long>(size / second), static_cast<unsigned long long>(size % second));
  return text.data();
}

std::string iso_time(std::int64_t nanoseconds) {
  const std::int64_t rest = (nanoseconds % second + second) % second;
  const std::time_t time = (nanoseconds - rest) / second;
  std::tm utc{};
  ::gmtime_r(&time, &utc);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02d-%02dT%02d:%02d:%02d.%09lldZ", utc.tm_year + 1900, utc.tm_mon + 1,
                utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, static_cast<long long>(rest));
  return text.data();
}

}  // namespace trk_bridge::base
