// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "timing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ostream>

#include <trk_bridge/TimeCode.h>

#include "base/number_text.h"
#include "base/time_text.h"
#include "bridge/diagnostic_text.h"
#include "reader.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::bag {
namespace {

constexpr double nanoseconds_per_second = 1e9;
constexpr double least_span = 2;  // s; over a shorter time, jitter is larger than the difference of rates
constexpr std::size_t most_distances = 100'000;
constexpr double rate_tolerance = 0.02;           // 48 Hz differs from 50 Hz by 4 %
constexpr std::int64_t day = 86'400'000'000'000;  // ns

template <typename Number>
std::optional<Number> number_of(const Connection& connection, const char* key) {
  const auto entry = connection.header.find(key);
  if (entry == connection.header.end()) return std::nullopt;
  const std::string& text = entry->second;
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

bool disagree(double rate, double measured) { return std::abs(measured / rate - 1) > rate_tolerance; }

}  // namespace

RecordedTiming recorded_timing(const std::vector<Connection>& connections, const std::string& topic) {
  RecordedTiming timing;
  bool is_first = true;
  for (const auto& connection : connections) {
    if (connection.topic != topic) continue;
    const auto rate = number_of<double>(connection, field_rate_key);
    const auto zero = number_of<std::int64_t>(connection, time_code_zero_key);
    if (is_first) timing = {rate, zero};
    if (rate != timing.field_rate) timing.field_rate.reset();
    if (zero != timing.time_code_zero) timing.time_code_zero.reset();
    is_first = false;
  }
  return timing;
}

FieldSeries::FieldSeries(bool has_counters, double field_rate)
    : has_counters_(has_counters), field_rate_(field_rate), sequence_(field_rate) {}

void FieldSeries::add(std::uint64_t counter, std::int64_t stamp) {
  if (count_ == 0) first_stamp_ = stamp;
  if (count_ > 0) add_distance(counter, stamp);
  find_gap(counter, stamp);
  ++count_;
  counter_ = counter;
  stamp_ = stamp;
}

void FieldSeries::add_distance(std::uint64_t counter, std::int64_t stamp) {
  if (!has_counters_) {
    if (distances_.size() < most_distances) distances_.push_back(stamp - stamp_);
  } else if (counter > counter_ && stamp > stamp_) {
    counts_ += static_cast<long double>(counter - counter_);
    nanoseconds_ += static_cast<long double>(stamp - stamp_);
  }
}

void FieldSeries::find_gap(std::uint64_t counter, std::int64_t stamp) {
  if (has_counters_) {
    const std::uint64_t lost = sequence_.counts().lost;
    const auto order = sequence_.classify(counter);
    const std::uint64_t now_lost = sequence_.counts().lost;
    if (order == base::Order::next && now_lost > lost) add_gap(now_lost - lost);
  } else if (count_ > 0) {
    const double steps = static_cast<double>(stamp - stamp_) * field_rate_ / nanoseconds_per_second;
    const auto missing = std::llround(steps) - 1;
    if (missing > 0) add_gap(static_cast<std::uint64_t>(missing));
  }
}

void FieldSeries::add_gap(std::uint64_t missing) {
  if (gaps_.gaps++ == 0) {
    gaps_.first = stamp_;
    gaps_.first_fields = missing;
  }
  gaps_.fields += missing;
}

std::optional<double> FieldSeries::measured_rate() const {
  if (count_ < 2 || bridge::seconds_between(first_stamp_, stamp_) < least_span) return std::nullopt;
  if (has_counters_) {
    if (nanoseconds_ <= 0) return std::nullopt;
    return static_cast<double>(counts_ * 1e9L / nanoseconds_);
  }
  std::vector<std::int64_t> distances = distances_;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  if (*middle <= 0) return std::nullopt;
  return nanoseconds_per_second / static_cast<double>(*middle);
}

void check_rate(double rate, std::optional<double> option, std::optional<double> measured, std::ostream& err) {
  if (!measured || !disagree(rate, *measured)) return;
  const std::string found = "the stamps give " + base::number_text(std::round(*measured * 1000) / 1000) +
                            " fields a second, not " + base::number_text(rate);
  if (!option) throw BagError(found + ": set --field-rate HZ");
  err << "trk: " << found << '\n';
}

std::optional<base::TimeCodeWithRate> recorded_time_code(Reader& bag, const std::string& topic, std::int64_t stamp) {
  std::optional<base::TimeCodeWithRate> found;
  const auto wanted = [&topic](const Connection& connection) {
    return connection.topic == topic && carries<trk_bridge::TimeCode>(connection);
  };
  bag.read_while(wanted, [&](const RawMessage& raw) {
    const auto message = message_of<trk_bridge::TimeCode>(raw);
    if (stamp_of(message) != stamp) return true;
    found = ros1::from_msg(message);
    const auto parsed = base::parse_time_code(base::to_string(found->code));
    if (!parsed) throw BagError("a message of " + topic + ": " + parsed.error());
    return false;
  });
  return found;
}

tl::expected<base::TimeCode, std::string> time_code_of(std::int64_t stamp, double field_rate,
                                                       std::optional<std::int64_t> zero) {
  const bool counts = zero && *zero <= stamp;
  return base::time_code_at(counts ? stamp - *zero : stamp % day, field_rate);
}

void FieldSeries::report_gaps(std::ostream& err) const {
  if (gaps_.gaps > 0) {
    err << "trk: " << gaps_.fields << " fields are missing in " << gaps_.gaps << " gaps, the first of "
        << gaps_.first_fields << " after " << base::seconds_text(gaps_.first)
        << ": the take holds the other fields without gaps, so it is shorter\n";
  }
  const auto& counts = sequence_.counts();
  if (counts.duplicates + counts.late + counts.restarts > 0) {
    err << "trk: " << counts.duplicates << " duplicate and " << counts.late << " late counters, and " << counts.restarts
        << " restarts of the counter: all of these fields are in the take\n";
  }
}

}  // namespace trk_bridge::bag
