// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Computes the stamps that trk_to_ros would have used: reads lines "counter arrival_ns" from standard input, writes
// "counter stamp_ns" to standard output. Lines that are not new (a duplicate or late counter) give no output, because
// trk_to_ros publishes nothing for them.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iostream>
#include <string>
#include <string_view>

#include "bridge/counter_clock.h"
#include "trk_bridge/base/sequence.h"

namespace {

using namespace trk_bridge;

template <typename Number>
bool take(std::string_view& text, Number& into) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), into);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool parse(std::string_view line, std::uint64_t& counter, std::int64_t& arrival) {
  return take(line, counter) && take(line, arrival) && line.find_first_not_of(" \t\r") == std::string_view::npos;
}

void summarize(const bridge::CounterClockStatistics& found) {
  const double rate = found.interval > 0 ? 1e9 / found.interval : 0;
  const bridge::StandardRate* standard = bridge::standard_rate(rate);
  std::cerr << "stamp_replay: " << rate << " Hz (" << (standard != nullptr ? standard->name : "none") << "), jitter "
            << found.jitter_before / 1e6 << " ms before, " << found.jitter_after / 1e6 << " ms after, "
            << found.outliers << " outliers, " << found.steps << " steps, " << found.restarts << " restarts, "
            << found.rate_changes << " rate changes\n";
}

}  // namespace

int main() {
  std::ios::sync_with_stdio(false);
  std::cin.tie(nullptr);
  base::Sequence sequence(50, base::CounterUse::automatic);
  bridge::CounterClock clock;
  std::string line;
  for (std::uint64_t number = 1; std::getline(std::cin, line); ++number) {
    std::uint64_t counter = 0;
    std::int64_t arrival = 0;
    if (!parse(line, counter, arrival)) {
      std::cerr << "stamp_replay: line " << number << ": \"" << line
                << "\": must be a counter (0 or more) and an arrival in ns, whole numbers\n";
      return 1;
    }
    // Only the counter of a record is known: an equal counter means the same record. 0 is not a valid fingerprint.
    if (!base::is_new(sequence.classify(counter, counter + 1))) continue;
    std::cout << counter << ' ';
    if (sequence.counts().state == base::CounterState::counts) {
      std::cout << clock.stamp(sequence.step(), arrival) << '\n';
      if (clock.statistics().learned) sequence.use_field_rate(1e9 / clock.statistics().interval);
    } else {
      clock.forget();
      std::cout << arrival << '\n';
    }
  }
  summarize(clock.statistics());
  return std::cout.flush() ? 0 : 1;
}
