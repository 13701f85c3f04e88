// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Which records of a camera are published: with counters of every kind, and with more than one sender.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>

#include "bridge/camera_pipeline.h"
#include "pipeline_samples.h"

namespace trk_bridge::bridge::camera_pipeline_senders_test {

/// 250 fields at 50 Hz: `counter_of` returns a field's counter. Every field has a different pose, x. Returns the
/// published ones, in their order.
std::vector<int> published_of(const std::function<std::uint64_t(int)>& counter_of, const std::vector<int>& fields,
                              CameraPipeline& pipeline) {
  std::vector<int> published;
  std::int64_t now = 0;
  for (const int i : fields) {
    auto p = params(counter_of(i));
    p.euler.x = i;
    now += field;
    if (const auto made = pipeline.process(sample(p, today + now), now); made.pose) {
      published.push_back(static_cast<int>(std::lround(made.pose->translation().x())));
    }
  }
  return published;
}

std::vector<int> all_fields() {
  std::vector<int> fields(250);
  std::iota(fields.begin(), fields.end(), 0);
  return fields;
}

TEST(Senders, NoCounterStopsASenderWithNewValues) {
  struct Case {
    const char* name;
    std::function<std::uint64_t(int)> counter_of;
    std::size_t least;
  };
  const auto count = [](int i) { return static_cast<std::uint64_t>(i); };
  const std::vector<Case> cases{
      {"constant", [](int) { return 0; }, 244},
      {"i % 10", [&](int i) { return count(i) % 10; }, 244},
      {"i % 30", [&](int i) { return count(i) % 30; }, 244},
      {"i % 45", [&](int i) { return count(i) % 45; }, 244},
      {"restart after 40", [&](int i) { return count(i < 40 ? i : i - 40); }, 244},
      {"restart after 12", [&](int i) { return count(i < 12 ? i : i - 12); }, 244},
      {"wraps at 2^16", [&](int i) { return (0xFFFF - 100 + count(i)) & 0xFFFFU; }, 250},
      {"wraps at 2^31", [&](int i) { return (0x7FFFFFFF - 100 + count(i)) & 0x7FFFFFFFU; }, 250},
      {"wraps at 2^32", [&](int i) { return (0xFFFFFFFF - 100 + count(i)) & 0xFFFFFFFFU; }, 250},
      {"wraps at 2^64", [&](int i) { return 0xFFFFFFFFFFFFFFFF - 100 + count(i); }, 250},
  };
  for (const auto& c : cases) {
    CameraPipeline pipeline(CameraOptions{}, 50);
    const auto published = published_of(c.counter_of, all_fields(), pipeline);
    EXPECT_GE(published.size(), c.least) << c.name;
    EXPECT_TRUE(std::is_sorted(published.begin(), published.end())) << c.name;
    EXPECT_EQ(std::adjacent_find(published.begin(), published.end()), published.end()) << c.name;
    RecordProperty(c.name, static_cast<int>(published.size()));

    // The same with a camera that stands still: only their number can be compared.
    CameraPipeline still(CameraOptions{}, 50);
    std::size_t count_still = 0;
    for (int i = 0; i < 250; ++i) {
      if (still.process(sample(params(c.counter_of(i)), today + i * field), i * field).pose) ++count_still;
    }
    EXPECT_GE(count_still, c.least) << c.name << ", standing still";
  }
}

TEST(Senders, AStrictCounterIsAlwaysObeyed) {
  CameraOptions strict;
  strict.counter = base::CounterUse::strict;
  CameraPipeline stands(strict, 50), circles(strict, 50);
  EXPECT_EQ(published_of([](int) { return 0; }, all_fields(), stands).size(), 1u);
  EXPECT_EQ(published_of([](int i) { return i % 30; }, all_fields(), circles).size(), 30u);
}

TEST(Senders, EveryFieldOnceIfEverySecondIsDuplicated) {
  std::vector<int> fields;
  for (const int i : all_fields()) fields.insert(fields.end(), i % 2 == 0 ? 1 : 2, i);
  CameraPipeline pipeline(CameraOptions{}, 50);
  EXPECT_EQ(published_of([](int i) { return i; }, fields, pipeline), all_fields());
  EXPECT_EQ(pipeline.statistics().sequence.duplicates, 125u);
  EXPECT_EQ(pipeline.statistics().sequence.state, base::CounterState::counts);
}

TEST(Senders, LateFieldsAreNeverPublishedOutOfOrder) {
  for (int by = 1; by <= 8; ++by) {
    // Every tenth field arrives `by` places later; then one field arrives before `by` others.
    auto one_late = all_fields();
    for (auto i = one_late.begin(); one_late.end() - i > 10; i += 10) std::rotate(i, i + 1, i + 1 + by);
    auto one_early = all_fields();
    for (auto i = one_early.begin(); one_early.end() - i > 10; i += 10) std::rotate(i, i + by, i + by + 1);
    for (const auto& fields : {one_late, one_early}) {
      CameraPipeline pipeline(CameraOptions{}, 50);
      const auto published = published_of([](int i) { return i; }, fields, pipeline);
      EXPECT_TRUE(std::is_sorted(published.begin(), published.end())) << by;
      const auto& counts = pipeline.statistics().sequence;
      EXPECT_EQ(published.size() + counts.late, 250u) << by;
      EXPECT_EQ(counts.restarts + counts.lost, 0u) << by;
    }
  }
}

/// `counter` from a sender with this port.
transport::Sample sample_from(std::uint32_t port, std::uint64_t counter, std::int64_t now) {
  auto s = sample(params(counter), today + now);
  s.sender.kind = transport::SenderKind::ipv4;
  s.sender.address = {192, 0, 2, 7};
  s.sender.number = port;
  return s;
}

TEST(Senders, OnlyTheFirstSenderIsFollowedUntilItIsSilent) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  const auto& statistics = pipeline.statistics();
  std::int64_t now = 0;
  for (std::uint64_t i = 0; i < 250; ++i, now += field) {
    EXPECT_TRUE(pipeline.process(sample_from(1000, i, now), now).pose);
    EXPECT_FALSE(pipeline.process(sample_from(2000, 700 + i, now + field / 2), now + field / 2).pose);
  }
  EXPECT_EQ(statistics.foreign, 250u);
  EXPECT_EQ(statistics.sender.number, 1000u);
  EXPECT_EQ(statistics.foreign_sender.number, 2000u);
  EXPECT_EQ(statistics.sequence.lost, 0u);

  // The first dies.
  const std::int64_t last = now - field;
  std::int64_t follows_at = 0;
  for (std::uint64_t i = 250; i < 300; ++i, now += field) {
    if (pipeline.process(sample_from(2000, 700 + i, now), now).pose && follows_at == 0) follows_at = now;
  }
  EXPECT_GE(follows_at - last, second / 2);
  EXPECT_LE(follows_at - last, second / 10 * 6);
  EXPECT_EQ(statistics.failovers, 1u);
  EXPECT_EQ(statistics.silent_sender.number, 1000u);
  EXPECT_EQ(statistics.sender.number, 2000u);
  EXPECT_EQ(statistics.sequence.lost + statistics.sequence.restarts, 0u) << "its counter is its own";
  EXPECT_FALSE(pipeline.process(sample_from(1000, 5000, now), now).pose) << "it is received again";
}

TEST(Senders, ForgedRecordsOfAnotherPortAreIgnoredAndOfTheSameCostLittle) {
  for (const std::uint32_t port : {1000u, 2000u}) {
    CameraPipeline pipeline(CameraOptions{}, 50);
    int good = 0, forged = 0;
    std::int64_t now = 0;
    for (std::uint64_t i = 0; i < 260; ++i, now += field) {
      if (pipeline.process(sample_from(1000, i, now), now).pose) ++good;
      if (i % 25 == 10 && pipeline.process(sample_from(port, i + 49, now + 1), now + 1).pose) ++forged;
    }
    EXPECT_EQ(good, 260) << port;
    // Senders with the same port cannot be distinguished.
    if (port != 1000) {
      EXPECT_EQ(forged, 0);
    }
  }
}

TEST(Senders, ConstantsOfAForeignSenderAreIgnored) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  ASSERT_TRUE(pipeline.process(sample_from(1000, 1, 0), 0).pose);
  auto s = sample_from(2000, 0, 0);
  s.record = constants();
  EXPECT_FALSE(pipeline.process(s, field).constants);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::none);
  EXPECT_EQ(pipeline.statistics().foreign, 1u);
  s.sender.number = 1000;
  EXPECT_TRUE(pipeline.process(s, field).constants);
}

TEST(Senders, ASenderOfInvalidCamerasCannotReplaceOthers) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto bad = sample_from(2000, 1, 0);
  std::get<wire::CameraParams>(bad.record).euler.pan = std::nan("");
  EXPECT_FALSE(pipeline.process(bad, 0).pose);
  EXPECT_TRUE(pipeline.process(sample_from(1000, 1, 1), 1).pose) << "it is not the camera's sender";
  // The camera's sender counts as silent if it sends only such records.
  bad.sender.number = 1000;
  for (std::int64_t now = 2; now < second; now += field) EXPECT_FALSE(pipeline.process(bad, now).pose);
  EXPECT_TRUE(pipeline.process(sample_from(2000, 1, second), second).pose);
}

TEST(Senders, ASenderMayUseAnotherPortForEveryDatagram) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  int published = 0;
  for (std::uint32_t i = 0; i < 250; ++i) {
    if (pipeline.process(sample_from(40000 + i, i, i * field), i * field).pose) ++published;
  }
  EXPECT_EQ(published, 250 - static_cast<int>(SenderLock::most_ports));
  EXPECT_TRUE(pipeline.statistics().ignores_ports);
}

TEST(Senders, WithoutFailoverEverySenderIsFollowed) {
  CameraOptions options;
  options.failover = 0;
  CameraPipeline pipeline(options, 50);
  EXPECT_TRUE(pipeline.process(sample_from(1000, 1, 0), 0).pose);
  EXPECT_TRUE(pipeline.process(sample_from(2000, 1, 1), 1).pose);
  EXPECT_TRUE(pipeline.process(sample_from(1000, 2, 2), 2).pose);
}

}  // namespace trk_bridge::bridge::camera_pipeline_senders_test
