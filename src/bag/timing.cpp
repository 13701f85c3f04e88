#include "timing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ostream>

#include <trk_bridge/TimeCode.h>

#include "base/time_text.h"
#include "bridge/diagnostic_text.h"
#include "cli/number_text.h"
#include "reader.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::bag {
namespace {

constexpr double nanoseconds_per_second = 1e9;
constexpr double least_span = 2;                  // s; below, jitter is more than what rates differ by
constexpr double rate_tolerance = 0.02;           // 48 Hz is 4 % from 50
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

std::optional<double> by_counters(const Fields& fields) {
  const auto& params = fields.params;
  const auto& stamps = fields.stamps;
  long double counts = 0;
  long double nanoseconds = 0;
  for (std::size_t i = 1; i < params.size(); ++i) {
    if (params[i].counter <= params[i - 1].counter || stamps[i] <= stamps[i - 1]) continue;
    counts += static_cast<long double>(params[i].counter - params[i - 1].counter);
    nanoseconds += static_cast<long double>(stamps[i] - stamps[i - 1]);
  }
  if (nanoseconds <= 0) return std::nullopt;
  return static_cast<double>(counts * 1e9L / nanoseconds);
}

std::optional<double> by_distances(const std::vector<std::int64_t>& stamps) {
  std::vector<std::int64_t> distances;
  for (std::size_t i = 1; i < stamps.size(); ++i) distances.push_back(stamps[i] - stamps[i - 1]);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  if (*middle <= 0) return std::nullopt;
  return nanoseconds_per_second / static_cast<double>(*middle);
}

bool disagree(double rate, double measured) { return std::abs(measured / rate - 1) > rate_tolerance; }

/// Missing fields between neighbours, as a gap at the stamp before.
struct Gaps {
  std::uint64_t gaps = 0, fields = 0, first_fields = 0;
  std::int64_t first = 0;

  void add(std::uint64_t missing, std::int64_t stamp) {
    if (gaps++ == 0) {
      first = stamp;
      first_fields = missing;
    }
    fields += missing;
  }
};

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

std::optional<double> measured_rate(const Fields& fields) {
  const auto& stamps = fields.stamps;
  if (stamps.size() < 2 || bridge::seconds_between(stamps.front(), stamps.back()) < least_span) return std::nullopt;
  return fields.has_counters ? by_counters(fields) : by_distances(stamps);
}

double field_rate_of(std::optional<double> option, std::optional<double> of_bag, std::optional<double> measured,
                     std::ostream& err) {
  const double rate = option ? *option : of_bag.value_or(default_field_rate);
  if (!measured || !disagree(rate, *measured)) return rate;
  const std::string found = "the stamps give " + cli::number_text(std::round(*measured * 1000) / 1000) +
                            " fields a second, not " + cli::number_text(rate);
  if (!option) throw BagError(found + ": set --field-rate HZ");
  err << "trk: " << found << '\n';
  return rate;
}

std::optional<base::CountedTimeCode> recorded_time_code(Reader& bag, const std::string& topic, std::int64_t stamp) {
  std::optional<base::CountedTimeCode> found;
  const auto wanted = [&topic](const Connection& connection) {
    return connection.topic == topic && carries<trk_bridge::TimeCode>(connection);
  };
  bag.read(wanted, [&](const RawMessage& raw) {
    const auto message = message_of<trk_bridge::TimeCode>(raw);
    if (stamp_of(message) != stamp) return;
    found = ros1::from_msg(message);
    const auto sound = base::parse_time_code(base::to_string(found->code));
    if (!sound) throw BagError("a message of " + topic + ": " + sound.error());
  });
  return found;
}

tl::expected<base::TimeCode, std::string> time_code_of(std::int64_t stamp, double field_rate,
                                                       std::optional<std::int64_t> zero) {
  const bool counts = zero && *zero <= stamp;
  return base::time_code_at(counts ? stamp - *zero : stamp % day, field_rate);
}

void report_gaps(const Fields& fields, double field_rate, std::ostream& err) {
  Gaps gaps;
  base::Sequence sequence(field_rate);
  std::uint64_t lost = 0;
  for (std::size_t i = 0; i < fields.params.size(); ++i) {
    if (fields.has_counters) {
      const auto order = sequence.judge(fields.params[i].counter);
      const std::uint64_t now_lost = sequence.counts().lost;
      if (order == base::Order::next && now_lost > lost) gaps.add(now_lost - lost, fields.stamps[i - 1]);
      lost = now_lost;
    } else if (i > 0) {
      const double steps =
          static_cast<double>(fields.stamps[i] - fields.stamps[i - 1]) * field_rate / nanoseconds_per_second;
      const auto missing = std::llround(steps) - 1;
      if (missing > 0) gaps.add(static_cast<std::uint64_t>(missing), fields.stamps[i - 1]);
    }
  }
  if (gaps.gaps > 0) {
    err << "trk: " << gaps.fields << " fields are missing in " << gaps.gaps << " gaps, the first of "
        << gaps.first_fields << " after " << base::seconds_text(gaps.first)
        << ": the take holds the other fields without gaps, and is shorter by them\n";
  }
  const auto& counts = sequence.counts();
  if (counts.duplicates + counts.late + counts.restarts > 0) {
    err << "trk: " << counts.duplicates << " counters came twice, " << counts.late << " late, and " << counts.restarts
        << " times the counter restarted: all of these fields are in the take\n";
  }
}

}  // namespace trk_bridge::bag
