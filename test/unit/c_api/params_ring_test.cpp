// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// trkNetBufReadParams's ring with networks that lose, repeat, reorder and delay datagrams: random, but the same in
// every run.
#include "c_api/params_ring.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace trk_bridge::c_api::params_ring_test {

/// One datagram. A sender that restarts begins a new run.
struct Set {
  int run = 0;
  std::uint64_t counter = 0;

  bool operator<(const Set& other) const { return std::tie(run, counter) < std::tie(other.run, other.counter); }
  bool operator==(const Set& other) const { return run == other.run && counter == other.counter; }
};

wire::CameraParams params_of(const Set& set) {
  wire::CameraParams p;
  p.counter = set.counter;
  p.focdist = set.run;  // different content: a restart is no duplicate
  return p;
}

/// Probabilities of errors per datagram or call.
struct Network {
  const char* name;
  double loss, twice, late, burst, restart;
};

constexpr Network networks[] = {
    {"loss", 0.1, 0, 0, 0, 0},   {"duplicates", 0, 0.2, 0, 0, 0}, {"reordering", 0, 0, 0.2, 0, 0},
    {"bursts", 0, 0, 0, 0.3, 0}, {"restarts", 0, 0, 0, 0, 0.01},  {"everything", 0.05, 0.1, 0.1, 0.2, 0.01},
};

/// The arrivals before each call of a reader; the sender sends one set per call.
std::vector<std::vector<Set>> arrivals_of(const Network& network, std::mt19937& random, std::size_t calls) {
  const auto happens = [&random](double probability) {
    return std::uniform_real_distribution<>(0, 1)(random) < probability;
  };
  std::vector<std::vector<Set>> arrivals(calls);
  std::map<std::size_t, std::vector<Set>> delayed;
  Set sent{0, 1000};
  std::size_t held_until = 0;  // bursts: nothing arrives before
  for (std::size_t call = 0; call < calls; ++call) {
    // A smaller step back could also be a late datagram.
    const bool is_far = sent.counter > base::Sequence::late_reach + 8;
    if (happens(network.restart) && delayed.empty() && is_far) sent = {sent.run + 1, 1};
    if (happens(network.burst)) held_until = call + std::uniform_int_distribution<std::size_t>(1, 3)(random);
    const std::size_t at = std::max(call, held_until);
    if (!happens(network.loss)) {
      const bool late = happens(network.late);
      const std::size_t delay = late ? std::uniform_int_distribution<std::size_t>(1, 3)(random) : 0;
      delayed[at + delay].push_back(sent);
      if (happens(network.twice)) delayed[at + delay + 1].push_back(sent);
    }
    ++sent.counter;
    if (const auto now = delayed.find(call); now != delayed.end()) {
      arrivals[call] = now->second;
      if (network.twice + network.late > 0) std::shuffle(arrivals[call].begin(), arrivals[call].end(), random);
      delayed.erase(now);
    }
  }
  return arrivals;
}

/// The document's rules for sets in order of arrival, as in existing programs.
class ArrivalOrderRing {
 public:
  void push(const Set& set) {
    sets_.push_back(set);
    if (sets_.size() > 16) sets_.pop_front();
  }
  std::optional<Set> pop_paced(std::uint64_t passed, std::uint64_t tolerated) {
    if (sets_.empty()) return std::nullopt;
    const Set newest = sets_.back();
    const bool ascends =
        std::is_sorted(sets_.begin(), sets_.end(), [](const Set& a, const Set& b) { return a.counter <= b.counter; });
    if (newest.counter > last_ && newest.counter - last_ <= passed + tolerated && sets_.size() < 16 && ascends) {
      for (std::size_t i = 0; i < sets_.size(); ++i) {
        if (sets_[i].counter < last_ + passed) continue;
        const Set found = sets_[i];
        sets_.erase(sets_.begin(), sets_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        last_ += passed;
        return found;
      }
    }
    sets_.clear();
    last_ = newest.counter;
    return newest;
  }

 private:
  std::deque<Set> sets_;
  std::uint64_t last_ = std::numeric_limits<std::uint64_t>::max();  // at first, no counter is greater
};

constexpr std::uint64_t passed = 1, tolerated = 2;

bool is_exact(const std::optional<Set>& before, const Set& given) {
  return before && before->run == given.run && given.counter == before->counter + passed;
}

/// Replays one sequence, checks every step, and returns how many were exact.
int exact_steps(const std::vector<std::vector<Set>>& arrivals) {
  ParamsRing ring;
  std::set<Set> arrived, given;
  std::optional<Set> last;
  std::uint64_t base = 0;  // steps are counted from here
  int exact = 0;
  for (const auto& now : arrivals) {
    for (const Set& set : now) {
      ring.push(params_of(set));
      arrived.insert(set);
    }
    const auto popped = ring.pop_paced(passed, tolerated);
    if (!popped) continue;
    const Set set{static_cast<int>(popped->focdist), popped->counter};
    EXPECT_TRUE(arrived.count(set));
    EXPECT_TRUE(given.insert(set).second) << set.counter << " was returned twice";
    const Set newest = *arrived.rbegin();
    if (last && last->run == newest.run) {
      EXPECT_EQ(set.run, last->run);
      EXPECT_GT(set.counter, last->counter) << "backwards";
      const Set wanted{last->run, base + passed};
      const auto queued = std::distance(arrived.upper_bound(*last), arrived.end());
      const bool is_ruled = newest.counter <= wanted.counter + tolerated && queued < 16;
      if (is_ruled && arrived.count(wanted) && *last < wanted) {
        EXPECT_EQ(set.counter, wanted.counter);
      }
      base = is_ruled && newest.counter >= wanted.counter ? wanted.counter : set.counter;
    } else {
      EXPECT_TRUE(set == newest) << "a run starts with the newest";
      base = set.counter;
    }
    if (is_exact(last, set)) ++exact;
    last = set;
  }
  return exact;
}

int exact_steps_in_order_of_arrival(const std::vector<std::vector<Set>>& arrivals) {
  ArrivalOrderRing ring;
  std::optional<Set> last;
  int exact = 0;
  for (const auto& now : arrivals) {
    for (const Set& set : now) ring.push(set);
    const auto set = ring.pop_paced(passed, tolerated);
    if (!set) continue;
    if (is_exact(last, *set)) ++exact;
    last = set;
  }
  return exact;
}

TEST(ParamsRing, a_thousand_sequences_step_by_step) {
  constexpr int sequences_of_a_kind = 200;
  constexpr std::size_t calls = 250;
  for (const Network& network : networks) {
    int exact = 0, in_order_of_arrival = 0;
    for (unsigned seed = 0; seed < sequences_of_a_kind; ++seed) {
      std::mt19937 random(seed);
      const auto arrivals = arrivals_of(network, random, calls);
      exact += exact_steps(arrivals);
      in_order_of_arrival += exact_steps_in_order_of_arrival(arrivals);
      ASSERT_FALSE(HasFailure()) << network.name << ", sequence " << seed;
    }
    RecordProperty(network.name, std::to_string(exact) + " exact steps of " +
                                     std::to_string(sequences_of_a_kind * calls) + ", in order of arrival " +
                                     std::to_string(in_order_of_arrival));
    EXPECT_GE(exact, in_order_of_arrival) << network.name;
    if (network.twice > 0 || network.late > 0) {
      EXPECT_GT(exact, in_order_of_arrival) << network.name;
    }
  }
}

TEST(ParamsRing, the_oldest_and_the_newest) {
  ParamsRing ring;
  for (const std::uint64_t counter : {1u, 3u, 2u, 3u}) ring.push(params_of({0, counter}));
  EXPECT_EQ(ring.size(), 3u);
  EXPECT_EQ(ring.pop_oldest()->counter, 1u);
  EXPECT_EQ(ring.pop_newest()->counter, 3u);
  EXPECT_FALSE(ring.pop_oldest());
  ring.push(params_of({0, 2}));
  EXPECT_EQ(ring.size(), 0u) << "given over";
}

TEST(ParamsRing, a_counter_that_stands_still_gives_every_record) {
  ParamsRing ring;
  int given = 0;
  for (int i = 0; i < 100; ++i) {
    auto p = params_of({0, 0});
    p.euler.x = i;
    p.format = 1;
    ring.push(p);
    if (ring.pop_paced(1, 2)) ++given;
  }
  EXPECT_EQ(given, 100);
}

}  // namespace trk_bridge::c_api::params_ring_test
