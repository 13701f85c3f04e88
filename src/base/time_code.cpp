// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/base/time_code.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "number_text.h"

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

/// How time codes count at a rate, in fields.
struct Counting {
  std::int64_t second = 0;   // per nominal second
  std::int64_t step = 1;     // from one sample to the next
  std::int64_t dropped = 0;  // skipped at the beginning of a minute

  std::int64_t ten_minutes() const { return 600 * second - 9 * dropped; }
  std::int64_t day() const { return 144 * ten_minutes(); }
  long double exact_second(double rate) const { return static_cast<long double>(exact_rate(rate)) * step; }
};

tl::expected<Counting, std::string> counting_of(double rate, bool drop_frame) {
  constexpr double highest_frame_rate = 30.5;
  Counting counting;
  if (rate < highest_frame_rate) counting.step = 2;
  counting.second = std::llround(rate) * counting.step;
  if (!drop_frame) return counting;
  const bool is_slow = counting.exact_second(rate) < static_cast<long double>(counting.second);
  if ((counting.second != 60 && counting.second != 120) || !is_slow) {
    return tl::unexpected("there is no drop-frame time code of " + number_text(rate) +
                          " Hz: allowed are 29.97, 59.94 and 119.88");
  }
  counting.dropped = counting.second / 15;
  return counting;
}

/// Fields since 00:00:00:00:1.
tl::expected<std::int64_t, std::string> count_of(const TimeCode& code, const Counting& counting) {
  const std::int64_t field_of_second = 2 * static_cast<std::int64_t>(code.frames) + code.field - 1;
  if (field_of_second >= counting.second) {
    return tl::unexpected("time code " + to_string(code) + " has a field that a second of " +
                          std::to_string(counting.second) + " fields does not have");
  }
  const bool begins_minute = code.minutes % 10 != 0 && code.seconds == 0;
  if (begins_minute && field_of_second < counting.dropped) {
    return tl::unexpected("time code " + to_string(code) + " does not exist: drop-frame skips it");
  }
  const std::int64_t minutes = code.hours * 60LL + code.minutes;
  return (minutes * 60 + code.seconds) * counting.second + field_of_second -
         counting.dropped * (minutes - minutes / 10);
}

TimeCode code_of(std::int64_t count, const Counting& counting) {
  count %= counting.day();
  // Adds the skipped codes again; the first of ten minutes has none.
  const std::int64_t tens = count / counting.ten_minutes(), within = count % counting.ten_minutes();
  const std::int64_t minute = 60 * counting.second;
  const std::int64_t shortened = within < minute ? 0 : 1 + (within - minute) / (minute - counting.dropped);
  count += counting.dropped * (9 * tens + shortened);
  const std::int64_t seconds = count / counting.second, field = count % counting.second;
  const auto part = [](std::int64_t value) { return static_cast<int>(value); };
  return TimeCode{part(seconds / 3600), part(seconds / 60 % 60), part(seconds % 60),
                  part(field / 2),      part(field % 2 + 1),     counting.dropped > 0};
}

}  // namespace

double exact_rate(double rate) noexcept {
  constexpr double most_rounded = 1e-5;
  const double exact = std::round(rate) * 1000 / 1001;
  return std::abs(rate - exact) < most_rounded * rate ? exact : rate;
}

tl::expected<TimeCode, std::string> parse_time_code(std::string_view text) {
  TimeCode code;
  std::string_view rest = text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_last = i + 1 == parts.size(), is_before_frames = i == 2;
    const std::size_t end = is_last ? rest.size() : rest.find_first_of(is_before_frames ? ":;" : ":");
    if (end == std::string_view::npos || !parse_part(rest.substr(0, end), parts[i], code)) {
      return tl::unexpected(
          "\"" + std::string(text.substr(0, 40)) +
          "\" is not a time code: HH:MM:SS:FF:D (drop-frame: HH:MM:SS;FF:D) with hours 0 to 23, minutes "
          "and seconds 0 to 59, frames and field 1 or 2");
    }
    if (is_before_frames) code.drop_frame = rest[end] == ';';
    rest.remove_prefix(is_last ? end : end + 1);
  }
  return code;
}

std::string to_string(const TimeCode& code) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%02d:%02d:%02d%c%02d:%d", code.hours, code.minutes, code.seconds,
                code.drop_frame ? ';' : ':', code.frames, code.field);
  return text.data();
}

tl::expected<TimeCodeSeries, std::string> TimeCodeSeries::from(const TimeCode& code, double field_rate) {
  const auto counting = counting_of(field_rate, code.drop_frame);
  if (!counting) return tl::unexpected(counting.error());
  const auto count = count_of(code, *counting);
  if (!count) return tl::unexpected(count.error());
  TimeCodeSeries series;
  series.second_ = counting->second;
  series.step_ = counting->step;
  series.dropped_ = counting->dropped;
  series.first_ = *count;
  series.exact_second_ = counting->exact_second(field_rate);
  return series;
}

std::int64_t TimeCodeSeries::nanoseconds(std::uint64_t index) const noexcept {
  const long double fields =
      static_cast<long double>(first_) + static_cast<long double>(index) * static_cast<long double>(step_);
  return static_cast<std::int64_t>(std::llround(fields * 1e9L / exact_second_));
}

TimeCode TimeCodeSeries::code(std::uint64_t index) const noexcept {
  const Counting counting{second_, step_, dropped_};
  const auto samples = static_cast<std::int64_t>(index % static_cast<std::uint64_t>(counting.day()));
  return code_of(first_ + samples * step_, counting);
}

tl::expected<std::int64_t, std::string> nanoseconds_of(const TimeCode& code, double field_rate, std::uint64_t index) {
  const auto series = TimeCodeSeries::from(code, field_rate);
  if (!series) return tl::unexpected(series.error());
  return series->nanoseconds(index);
}

tl::expected<TimeCode, std::string> time_code_after(const TimeCode& code, double field_rate, std::uint64_t index) {
  const auto series = TimeCodeSeries::from(code, field_rate);
  if (!series) return tl::unexpected(series.error());
  return series->code(index);
}

tl::expected<TimeCode, std::string> time_code_at(std::int64_t nanoseconds, double field_rate, bool drop_frame) {
  const auto refuse = [&](const std::string& why) {
    return tl::unexpected("no time code expresses " + std::to_string(nanoseconds) + " ns after midnight at " +
                          number_text(field_rate) + " fields a second: " + why);
  };
  if (nanoseconds < 0) return refuse("it is before midnight");
  if (!(field_rate >= 1 && field_rate <= 1e6)) return refuse("rates are 1 to 1000000 Hz");
  const auto counting = counting_of(field_rate, drop_frame);
  if (!counting) return tl::unexpected(counting.error());
  const long double seconds = static_cast<long double>(nanoseconds) / 1e9L;
  const TimeCode code = code_of(std::llround(seconds * counting->exact_second(field_rate)), *counting);
  if (code.frames > parts[3].most) return refuse("frame " + std::to_string(code.frames) + " has more than two digits");
  return code;
}

}  // namespace trk_bridge::base
