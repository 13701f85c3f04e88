// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/counter_clock.h"

#include <functional>
#include <map>

#include <gmock/gmock.h>

#include "counter_signal.h"
#include "trk_bridge/base/sequence.h"

namespace trk_bridge::bridge::counter_clock_test {

constexpr double second = 1e9, millisecond = 1e6;  // ns
constexpr double jitter = 2 * millisecond;         // standard deviation

struct Stamped {
  Delivered sample;
  std::int64_t stamp = 0;
  bool learned = false;

  double late() const { return static_cast<double>(sample.arrival - signal_begin) - sample.sampled; }
  double error() const { return static_cast<double>(stamp - signal_begin) - sample.sampled; }
  double time() const { return sample.sampled / second; }
};

/// Sums over samples, for the variances of arrivals and stamps.
class Spread {
 public:
  void add(const std::vector<Stamped>& stamped, double from, double to) {
    double n = 0, late = 0, late2 = 0, error = 0, error2 = 0;
    for (const Stamped& s : stamped) {
      if (s.time() < from || s.time() >= to) continue;
      ++n;
      late += s.late();
      late2 += s.late() * s.late();
      error += s.error();
      error2 += s.error() * s.error();
    }
    arrivals_ += late2 / n - late / n * (late / n);
    stamps_ += error2 / n - error / n * (error / n);
  }
  /// Root mean square of arrivals over that of stamps.
  double ratio() const { return std::sqrt(arrivals_ / stamps_); }

 private:
  double arrivals_ = 0, stamps_ = 0;
};

double mean_error(const std::vector<Stamped>& stamped, double from, double to) {
  double n = 0, sum = 0;
  for (const Stamped& s : stamped) {
    if (s.time() < from || s.time() >= to) continue;
    ++n;
    sum += s.error();
  }
  return sum / n;
}

std::string text_of(const Signal& s) {
  return name_of(s.jitter) + ", " + std::to_string(s.rate) + " Hz, seed " + std::to_string(s.seed);
}

/// The stamps of a camera's samples, without those that are not new. What holds for every signal is checked here.
struct Replay {
  explicit Replay(const Signal& signal) {
    base::Sequence sequence(50, base::CounterUse::automatic);
    std::int64_t before = 0;
    for (const Delivered& sample : deliver(signal)) {
      if (!base::is_new(sequence.classify(sample.counter, sample.counter + 1))) continue;
      const std::int64_t stamp = clock.stamp(sequence.step(), sample.arrival);
      stamped.push_back({sample, stamp, found.learned});
      const bool is_valid = stamp <= sample.arrival && stamp >= sample.arrival - 500'000'000 && stamp > before;
      if (!is_valid) ADD_FAILURE() << text_of(signal) << ": stamp at " << stamped.back().time() << " s";
      before = stamp;
    }
  }

  CounterClock clock;
  const CounterClockStatistics& found = clock.statistics();
  std::vector<Stamped> stamped;
};

constexpr unsigned seeds = 3;

/// Every jitter and rate; `check` gets the signals of all seeds.
void for_all_signals(double seconds, const std::function<void(const std::vector<Signal>&)>& check,
                     unsigned most = seeds) {
  for (const Jitter kind : {Jitter::gauss, Jitter::uniform, Jitter::exponential, Jitter::mixed}) {
    for (const double rate : {50.0, 60000 / 1001.0, 120000 / 1001.0}) {
      std::vector<Signal> signals(most);
      for (unsigned i = 0; i < most; ++i) {
        signals[i].jitter = kind;
        signals[i].rate = rate;
        signals[i].seed = i + 1;
        signals[i].seconds = seconds;
        signals[i].deviation = jitter;
      }
      check(signals);
    }
  }
}

TEST(CounterClock, JitterIsATenthAfter10ATwentiethAfter40AThirtiethAfter90Seconds) {
  for_all_signals(
      180,
      [](const std::vector<Signal>& signals) {
        std::map<double, Spread> from;
        for (const Signal& signal : signals) {
          const Replay replay(signal);
          for (const double begin : {10., 40., 90.}) from[begin].add(replay.stamped, begin, 180);
          const double interval = 1e9 / signal.rate * (1 + 1e-6 * signal.ppm);
          EXPECT_NEAR(replay.found.interval, interval, 3e-6 * interval) << text_of(signal);
          EXPECT_NEAR(replay.found.jitter_before, jitter, 0.75 * jitter) << text_of(signal);
          EXPECT_LT(replay.found.jitter_after, replay.found.jitter_before / 15) << text_of(signal);
          EXPECT_EQ(replay.found.steps + replay.found.restarts + replay.found.rate_changes, 0u) << text_of(signal);
        }
        EXPECT_GE(from[10].ratio(), 10) << text_of(signals[0]);
        EXPECT_GE(from[40].ratio(), 20) << text_of(signals[0]);
        EXPECT_GE(from[90].ratio(), 30) << text_of(signals[0]);
      },
      8);
}

TEST(CounterClock, StampsAreAtTheEarlyEdgeOfTheArrivals) {
  for_all_signals(120, [](const std::vector<Signal>& signals) {
    const Replay replay(signals[0]);
    double before = 0, clamped = 0, n = 0;
    for (const Stamped& s : replay.stamped) {
      if (s.time() < 40) continue;
      ++n;
      before += s.late() - s.error();
      if (s.stamp == s.sample.arrival) ++clamped;
    }
    EXPECT_LT(clamped / n, 0.01) << text_of(signals[0]);
    EXPECT_GT(before / n, 0.5 * jitter) << text_of(signals[0]);
    EXPECT_LT(before / n, 4 * jitter) << text_of(signals[0]);
  });
}

TEST(CounterClock, StampsAreArrivalsUntilTheRhythmIsKnownAndThenChangeWithoutAStep) {
  for_all_signals(20, [](const std::vector<Signal>& signals) {
    for (const Signal& signal : signals) {
      const Replay replay(signal);
      double before = 0;
      for (const Stamped& s : replay.stamped) {
        if (s.time() < 1.9) {
          EXPECT_EQ(s.stamp, s.sample.arrival) << text_of(signal);
        }
        if (s.time() > 2.1) {
          EXPECT_TRUE(s.learned) << text_of(signal);
        }
        // The difference from the arrival grows from 0 to its end, and never by more than the jump of the arrivals.
        if (s.time() > 2 && s.time() < 6) {
          EXPECT_LE(std::abs(s.error() - before), 12 * jitter) << text_of(signal) << " at " << s.time();
        }
        before = s.error();
      }
      Spread in_between, later;
      in_between.add(replay.stamped, 2, 4);
      later.add(replay.stamped, 5, 7);
      EXPECT_GT(later.ratio(), 5 * std::min(1.0, in_between.ratio())) << text_of(signal);
    }
  });
}

TEST(CounterClock, AStallThatEndsInABurstMovesStampsByATenthOfTheJitterAtMost) {
  for_all_signals(
      110,
      [](const std::vector<Signal>& signals) {
        const Replay even(signals[0]);
        std::map<std::uint64_t, const Stamped*> of_counter;
        for (const Stamped& s : even.stamped) of_counter[s.sample.counter] = &s;
        for (const double at : {12., 30., 100.}) {
          for (const double lasts : {0.05, 0.1, 0.2, 0.3}) {
            Signal stalled = signals[0];
            stalled.stall = at;
            stalled.stall_lasts = lasts;
            const Replay replay(stalled);
            double worst = 0;
            for (const Stamped& s : replay.stamped) {
              const auto other = of_counter.find(s.sample.counter);
              if (other == of_counter.end()) continue;
              // A sample that arrives before its stamp is stamped with its arrival.
              if (s.stamp == s.sample.arrival || other->second->stamp == other->second->sample.arrival) continue;
              worst = std::max(worst, std::abs(s.error() - other->second->error()));
            }
            EXPECT_LE(worst, jitter / 10) << text_of(signals[0]) << ", " << lasts << " s at " << at;
            EXPECT_EQ(replay.found.steps + replay.found.restarts + replay.found.rate_changes, 0u);
          }
        }
      },
      1);
}

TEST(CounterClock, AStepOfTheDelayIsFollowedIn10SecondsAndTheRateStays) {
  for (const double by : {3., -3., 7., -7., 60.}) {
    for_all_signals(120, [by](const std::vector<Signal>& signals) {
      Spread later;
      for (Signal signal : signals) {
        signal.delay = [by](double time) { return time < 60 * second ? 0 : by * millisecond; };
        const std::string what = text_of(signal) + ", step " + std::to_string(by);
        const Replay replay(signal);
        EXPECT_EQ(replay.found.steps, 1u) << what;
        EXPECT_GT(replay.found.last_step * by, 0) << what;
        EXPECT_EQ(replay.found.restarts + replay.found.rate_changes, 0u) << what;
        const double moved = mean_error(replay.stamped, 70, 120) - mean_error(replay.stamped, 40, 60);
        EXPECT_NEAR(moved, by * millisecond, jitter / 3) << what;
        const double interval = 1e9 / signal.rate * 1.0001;
        EXPECT_NEAR(replay.found.interval, interval, 10e-6 * interval) << what;
        for (const Stamped& s : replay.stamped) EXPECT_TRUE(s.learned || s.time() < 3) << what;
        later.add(replay.stamped, 70, 120);
      }
      EXPECT_GE(later.ratio(), 10) << text_of(signals[0]) << ", step " << by;
    });
  }
}

TEST(CounterClock, ARestartIsFollowedIn10SecondsAndTheRateIsKept) {
  for (const double pause : {0.0, 1.0, 7.3}) {
    for_all_signals(120, [pause](const std::vector<Signal>& signals) {
      Spread later;
      for (Signal signal : signals) {
        const auto before = static_cast<std::uint64_t>(60 * signal.rate);
        signal.counter = [before](std::uint64_t n) { return n < before ? n + 100000 : n - before; };
        signal.time = [=](std::uint64_t n, double interval) {
          return static_cast<double>(n) * interval + (n < before ? 0 : pause * second + 0.37 * interval);
        };
        const Replay replay(signal);
        EXPECT_EQ(replay.found.restarts, 1u) << text_of(signal);
        EXPECT_EQ(replay.found.rate_changes, 0u) << text_of(signal);
        later.add(replay.stamped, 70 + pause, 120);
      }
      EXPECT_GE(later.ratio(), 10) << text_of(signals[0]) << ", pause " << pause;
    });
  }
}

TEST(CounterClock, ATimeCodeThatWrapsAtMidnightContinues) {
  for_all_signals(120, [](const std::vector<Signal>& signals) {
    for (Signal signal : signals) {
      const auto day = static_cast<std::uint64_t>(24 * 3600 * std::round(signal.rate));
      const auto start = day - static_cast<std::uint64_t>(60 * signal.rate);
      signal.counter = [=](std::uint64_t n) { return (start + n) % day; };
      const Replay replay(signal);
      EXPECT_EQ(replay.found.restarts, 1u) << text_of(signal);
      EXPECT_EQ(replay.found.steps + replay.found.rate_changes, 0u) << text_of(signal);
      for (const Stamped& s : replay.stamped) EXPECT_TRUE(s.learned || s.time() < 3) << text_of(signal);
      Spread around;
      around.add(replay.stamped, 55, 65);
      EXPECT_GE(around.ratio(), 15) << text_of(signal);
    }
  });
}

TEST(CounterClock, ACounterThatJumpsContinues) {
  for (const std::uint64_t jump : {7u, 100u, 1000u, 100000u}) {
    for_all_signals(90, [jump](const std::vector<Signal>& signals) {
      for (Signal signal : signals) {
        const auto before = static_cast<std::uint64_t>(60 * signal.rate);
        signal.counter = [=](std::uint64_t n) { return n < before ? n : n + jump; };
        const std::string what = text_of(signal) + ", by " + std::to_string(jump);
        const Replay replay(signal);
        EXPECT_EQ(replay.found.restarts, 1u) << what;
        EXPECT_EQ(replay.found.steps + replay.found.rate_changes, 0u) << what;
        Spread later;
        later.add(replay.stamped, 61, 90);
        EXPECT_GE(later.ratio(), 10) << what;
      }
    });
  }
}

/// After a minute at their rate the signals continue at `to`.
void expect_rate_is_learned(double to, double within) {
  for_all_signals(120, [to, within](const std::vector<Signal>& signals) {
    if (std::abs(to / signals[0].rate - 1) < 1e-4) return;
    Spread later;
    for (Signal signal : signals) {
      const auto before = static_cast<std::uint64_t>(60 * signal.rate);
      const double slower = signal.rate / to;
      signal.time = [=](std::uint64_t n, double interval) {
        const double at = static_cast<double>(std::min(n, before)) * interval;
        return n <= before ? at : at + static_cast<double>(n - before) * interval * slower;
      };
      const std::string what = text_of(signal) + ", to " + std::to_string(to);
      const Replay replay(signal);
      EXPECT_EQ(replay.found.rate_changes, 1u) << what;
      EXPECT_EQ(replay.found.steps + replay.found.restarts, 0u) << what;
      const StandardRate* name = standard_rate(1e9 / replay.found.interval);
      ASSERT_NE(name, nullptr) << what;
      EXPECT_NEAR(name->rate, to, 1e-9) << what;
      later.add(replay.stamped, 60 + within, 120);
    }
    EXPECT_GE(later.ratio(), 10) << text_of(signals[0]) << ", to " << to;
  });
}

TEST(CounterClock, AnotherRateIsMeasuredIn10Seconds) {
  for (const double to : {48.0, 50.0, 60000 / 1001.0, 100.0, 120000 / 1001.0}) expect_rate_is_learned(to, 10);
}

TEST(CounterClock, ARateThatDiffersBy1000PpmIsMeasuredIn15Seconds) { expect_rate_is_learned(60, 15); }

TEST(CounterClock, FollowsARateThatDrifts) {
  for_all_signals(300, [](const std::vector<Signal>& signals) {
    Spread later;
    for (Signal signal : signals) {
      // 20 ppm up and down in 10 minutes.
      signal.time = [](std::uint64_t n, double interval) {
        const double time = static_cast<double>(n) * interval, period = 600 * second;
        return time + 20e-6 * period / (2 * M_PI) * (1 - std::cos(2 * M_PI * time / period));
      };
      const Replay replay(signal);
      EXPECT_EQ(replay.found.steps + replay.found.restarts + replay.found.rate_changes, 0u) << text_of(signal);
      later.add(replay.stamped, 40, 300);
    }
    EXPECT_GE(later.ratio(), 10) << text_of(signals[0]);
  });
}

TEST(CounterClock, JitterThatBecomesTenTimesLargerIsNotAStep) {
  for (const bool grows : {true, false}) {
    Signal small, large;
    small.seconds = large.seconds = 60;
    small.deviation = grows ? 0.2 * millisecond : jitter;
    large.deviation = grows ? jitter : 0.2 * millisecond;
    CounterClock clock;
    std::uint64_t counts = 1;
    std::uint64_t newest = 0;
    for (const Signal& part : {small, large}) {
      const std::uint64_t first = newest;
      const std::int64_t shift = first == 0 ? 0 : std::llround(static_cast<double>(first) * 20'002'000.0);
      for (const Delivered& d : deliver(part)) {
        if (first + d.counter <= newest) continue;
        counts = first + d.counter - newest;
        newest = first + d.counter;
        EXPECT_LE(clock.stamp(counts, d.arrival + shift), d.arrival + shift);
      }
    }
    EXPECT_EQ(clock.statistics().steps + clock.statistics().rate_changes + clock.statistics().restarts, 0u);
    if (grows) {
      EXPECT_NEAR(clock.statistics().jitter_before, jitter, 0.3 * jitter);
    }
  }
}

TEST(CounterClock, WithoutJitterStampsAreExactToAMicrosecond) {
  Signal even;
  even.deviation = 0;
  even.ppm = 0;
  const Replay replay(even);
  for (const Stamped& s : replay.stamped) EXPECT_NEAR(s.error(), signal_delay, 1000);
  EXPECT_NEAR(replay.found.interval, 20e6, 1);
}

TEST(CounterClock, AnotherSenderIsMeasuredFromItsStart) {
  CounterClock clock;
  const auto feed = [&clock](std::int64_t begin, std::int64_t interval) {
    int arrivals = 0;
    for (std::int64_t i = 0; i < 500; ++i) {
      const std::int64_t arrival = begin + i * interval + (i % 3) * 300'000;
      if (clock.stamp(1, arrival) == arrival) ++arrivals;
    }
    return arrivals;
  };
  EXPECT_GE(feed(signal_begin, 20'000'000), 100);
  EXPECT_TRUE(clock.statistics().learned);
  clock.forget();
  EXPECT_FALSE(clock.statistics().learned);
  EXPECT_GE(feed(signal_begin + 60'000'000'000, 10'000'000), 200);
  EXPECT_NEAR(clock.statistics().interval, 10e6, 10e6 * 20e-6);
  EXPECT_EQ(clock.statistics().restarts + clock.statistics().rate_changes, 0u);
}

TEST(CounterClock, SamplesWithoutRhythmHaveArrivalsAsStamps) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> pause(1 * millisecond, 500 * millisecond);
  CounterClock clock;
  std::int64_t arrival = signal_begin;
  int arrivals = 0;
  for (int n = 0; n < 1000; ++n) {
    arrival += std::llround(pause(engine));
    const std::int64_t stamp = clock.stamp(1, arrival);
    EXPECT_LE(stamp, arrival);
    if (stamp == arrival) ++arrivals;
  }
  EXPECT_GT(arrivals, 800);
}

TEST(CounterClock, AClockThatIsSetIsFollowed) {
  CounterClock clock;
  std::int64_t shift = 0;
  for (std::int64_t i = 0; i < 3000; ++i) {
    if (i == 1000) shift = -3'600'000'000'000;
    if (i == 2000) shift = 7'200'000'000'000;
    const std::int64_t arrival = signal_begin + shift + i * 20'000'000 + (i % 3) * 300'000;
    const std::int64_t stamp = clock.stamp(1, arrival);
    EXPECT_LE(stamp, arrival);
    EXPECT_GE(stamp, arrival - 500'000'000);
  }
  EXPECT_EQ(clock.statistics().restarts, 2u);
  EXPECT_NEAR(clock.statistics().interval, 20e6, 20e6 * 10e-6);
}

TEST(StandardRates, AreNamedWithin300Ppm) {
  const std::map<std::string, double> exact{{"23.976", 24000 / 1001.0},
                                            {"24", 24},
                                            {"25", 25},
                                            {"29.97", 30000 / 1001.0},
                                            {"30", 30},
                                            {"47.952", 48000 / 1001.0},
                                            {"48", 48},
                                            {"50", 50},
                                            {"59.94", 60000 / 1001.0},
                                            {"60", 60},
                                            {"100", 100},
                                            {"119.88", 120000 / 1001.0},
                                            {"120", 120}};
  for (const auto& [name, rate] : exact) {
    for (const double ppm : {-250., 0., 250.}) {
      const StandardRate* found = standard_rate(rate * (1 + 1e-6 * ppm));
      ASSERT_NE(found, nullptr) << name;
      EXPECT_EQ(found->name, name);
      EXPECT_DOUBLE_EQ(found->rate, rate);
    }
    EXPECT_EQ(standard_rate(rate * 1.0004), nullptr) << name;
  }
  EXPECT_EQ(standard_rate(0), nullptr);
  EXPECT_EQ(standard_rate(75), nullptr);
}

}  // namespace trk_bridge::bridge::counter_clock_test
