#include "bridge/camera_pipeline.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge {
namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t today = 1'700'000'000 * second;
constexpr std::int64_t field = 20'000'000;

wire::CameraConstants constants(std::uint32_t id = 0) { return {id, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39}; }

/// Euler, with an image distance: needs no constants.
wire::CameraParams params(std::uint64_t counter, std::uint32_t id = 0) {
  wire::CameraParams p;
  p.id = id;
  p.format = wire::euler;
  p.euler = {1, 2, 3, 30, -5, 0};
  p.fov = 10;
  p.counter = counter;
  return p;
}

transport::Sample sample(const wire::Record& record, std::int64_t arrival = today) {
  transport::Sample s;
  s.record = record;
  s.arrival = arrival;
  return s;
}

TEST(CameraPipeline, OneStampForEverythingOfASample) {
  CameraOptions options;
  options.delay = 0.04;
  CameraPipeline pipeline(options, 50);
  EXPECT_TRUE(pipeline.process(sample(constants()), 0).constants);
  const auto made = pipeline.process(sample(params(1)), 5);
  ASSERT_TRUE(made.params && made.calibration && made.pose);
  EXPECT_EQ(made.stamp, today - 40'000'000);
  EXPECT_EQ(pipeline.statistics().last_new, 5);
}

TEST(CameraPipeline, DuplicatesAndLateOnesGiveNothingARestartDoes) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  const auto published = [&pipeline](std::uint64_t counter, std::int64_t arrival) {
    const auto made = pipeline.process(sample(params(counter), arrival), 0);
    EXPECT_EQ(made.params.has_value(), made.pose.has_value());
    return made.stamp;
  };
  EXPECT_TRUE(published(1000, today));
  const auto before = published(1002, today + field);
  EXPECT_TRUE(before);
  EXPECT_FALSE(published(1002, today + 2 * field)) << "duplicate";
  EXPECT_FALSE(published(1001, today + 3 * field)) << "late";
  EXPECT_GT(published(1, today), before) << "restart, with a clock that stepped back a little";
  const auto& counts = pipeline.statistics().sequence;
  EXPECT_EQ(counts.accepted, 3u);
  EXPECT_EQ(counts.duplicates, 1u);
  EXPECT_EQ(counts.late, 1u);
  EXPECT_EQ(counts.lost, 0u);
  EXPECT_EQ(counts.restarts, 1u);
  EXPECT_EQ(pipeline.statistics().held_stamps, 1u);
}

TEST(CameraPipeline, AMatrixThatIsNoRotationIsDropped) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto p = params(1);
  p.format = 0;
  p.matrix = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const auto made = pipeline.process(sample(p), 0);
  EXPECT_FALSE(made.params || made.pose || made.calibration);
  EXPECT_EQ(pipeline.statistics().dropped, 1u);
  EXPECT_EQ(pipeline.statistics().drop_reason, camera::CameraReason::not_a_rotation);
}

TEST(CameraPipeline, WhatIsNotFiniteIsDropped) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  std::uint64_t counter = 0;
  for (double wire::CameraParams::*field_of : {&wire::CameraParams::fov, &wire::CameraParams::k1,
                                               &wire::CameraParams::center_x, &wire::CameraParams::focdist}) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      auto p = params(++counter);
      p.*field_of = bad;
      const auto made = pipeline.process(sample(p), 0);
      EXPECT_FALSE(made.params || made.pose || made.calibration);
    }
  }
  auto p = params(++counter);
  p.euler.pan = std::nan("");
  EXPECT_FALSE(pipeline.process(sample(p), 0).pose);
  EXPECT_EQ(pipeline.statistics().dropped, counter);
}

TEST(CameraPipeline, WithholdsParamsThatNeedUnknownConstantsWhileTheTransformGoesOn) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto p = params(1);
  p.format |= wire::field_of_view;
  p.fov = 50;
  auto made = pipeline.process(sample(p), 0);
  EXPECT_TRUE(made.pose);
  EXPECT_FALSE(made.params || made.calibration);
  EXPECT_EQ(pipeline.statistics().withheld, 1u);
  EXPECT_EQ(pipeline.statistics().withhold_reason, camera::CameraReason::constants_needed);

  EXPECT_TRUE(pipeline.process(sample(constants()), 0).constants);
  p.counter = 2;
  made = pipeline.process(sample(p), 0);
  ASSERT_TRUE(made.params && made.calibration && made.pose);
  EXPECT_EQ(made.params->format, wire::euler);
  EXPECT_NEAR(made.params->fov, 9.59 / 2 / std::tan(25 * M_PI / 180), 1e-12);
  EXPECT_EQ(made.params->counter, 2u);
}

TEST(CameraPipeline, AsReceivedLeavesTheRecordAlone) {
  CameraOptions configured;
  configured.format.reset();
  CameraPipeline pipeline(configured, 50);
  auto p = params(1);
  p.format |= wire::field_of_view | wire::diagonal | wire::shift_in_pixels | 0x400;
  p.fov = 50;
  p.center_x = 3;
  const auto made = pipeline.process(sample(p), 0);
  ASSERT_TRUE(made.params);
  EXPECT_EQ(made.params->format, p.format);
  EXPECT_EQ(made.params->fov, 50);
  EXPECT_EQ(made.params->center_x, 3);
}

TEST(CameraPipeline, ReceivedConstantsWinOverTheParameterAndOwnOnesOverThoseOfAnyCamera) {
  CameraOptions configured;
  configured.id = 7;
  configured.constants = constants();
  configured.constants->image_width = 720;
  CameraPipeline pipeline(configured, 50);
  ASSERT_TRUE(pipeline.initial().constants);
  EXPECT_EQ(pipeline.initial().constants->image_width, 720);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::parameter);

  auto made = pipeline.process(sample(constants(0)), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.constants->image_width, 1920);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::any_camera);

  auto own = constants(7);
  own.image_width = 1280;
  made = pipeline.process(sample(own), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.constants->image_width, 1280);
  EXPECT_FALSE(pipeline.process(sample(own), 0).constants) << "unchanged";
  EXPECT_FALSE(pipeline.process(sample(constants(0)), 0).constants) << "has its own";
  EXPECT_EQ(pipeline.process(sample(params(1, 7)), 0).calibration.value().width, 1280u);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::own);
}

TEST(CameraPipeline, WithoutConstantsItHasNoneToBeginWith) {
  EXPECT_FALSE(CameraPipeline(CameraOptions{}, 50).initial().constants);
}

TEST(CameraPipeline, ConstantsAreStampedWithArrivalLessDelayAndGoWithThePublishedFormat) {
  CameraOptions configured;
  configured.delay = 0.04;
  configured.format = wire::euler | wire::field_of_view | wire::keep_aspect;
  CameraPipeline pipeline(configured, 50);
  auto received = constants();
  received.fake_chip_width = 0;
  auto made = pipeline.process(sample(received), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.stamp, today - 40'000'000);
  EXPECT_EQ(*made.constants, camera::constants_for(received, *configured.format));
  EXPECT_NE(*made.constants, received);

  received.image_width = 1280;
  made = pipeline.process(sample(received, -1), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.stamp, 0) << "no time is known";
}

TEST(CameraPipeline, ConstantsWithoutAPictureAreIgnored) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  auto bad = constants();
  bad.blank_left = 1920;
  EXPECT_FALSE(pipeline.process(sample(bad), 0).constants);
  EXPECT_EQ(pipeline.statistics().bad_constants, 1u);
  EXPECT_TRUE(pipeline.process(sample(params(1)), 0).calibration) << "those before stay";
}

TEST(CameraPipeline, WantsItsIdOrAnyWhereItHasNone) {
  CameraOptions configured;
  EXPECT_TRUE(CameraPipeline(configured, 50).wants(params(1, 3)));
  configured.id = 7;
  const CameraPipeline pipeline(configured, 50);
  EXPECT_TRUE(pipeline.wants(params(1, 7)));
  EXPECT_FALSE(pipeline.wants(params(1, 3)));
  EXPECT_FALSE(pipeline.wants(params(1, 0)));
  EXPECT_TRUE(pipeline.wants(constants(7)));
  EXPECT_TRUE(pipeline.wants(constants(0)));
  EXPECT_FALSE(pipeline.wants(constants(3)));
}

TEST(CameraPipeline, CountsIdsThatChange) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  for (const std::uint32_t id : {3u, 3u, 4u, 3u}) (void)pipeline.process(sample(params(1, id)), 0);
  EXPECT_EQ(pipeline.statistics().id_changes, 2u);
}

TEST(CameraPipeline, NoCameraInfoForALensThatFoldsTheImage) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  auto p = params(1);
  p.k1 = -0.05;  // folds at r = sqrt(1 / 0.15) = 2.6 mm, the corner is at 5.5 mm
  const auto made = pipeline.process(sample(p), 0);
  EXPECT_TRUE(made.pose && made.params);
  EXPECT_FALSE(made.calibration);
  EXPECT_EQ(pipeline.statistics().info_reason, camera::CameraReason::not_monotonic);
}

TEST(CameraPipeline, WhatIsSwitchedOffIsNotMade) {
  CameraOptions configured;
  configured.publish_tf = false;
  configured.publish_camera_info = false;
  CameraPipeline pipeline(configured, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  const auto made = pipeline.process(sample(params(1)), 0);
  EXPECT_TRUE(made.params);
  EXPECT_FALSE(made.pose || made.calibration);
  EXPECT_EQ(pipeline.statistics().without_camera_info, 0u);
}

TEST(CameraPipeline, WithoutACounterEveryRecordIsNew) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  for (int i = 0; i < 3; ++i) {
    auto s = sample(params(0), today + i * field);
    s.has_counter = false;
    const auto made = pipeline.process(s, i);
    ASSERT_TRUE(made.params && made.pose);
    EXPECT_EQ(made.stamp, today + i * field);
    EXPECT_EQ(pipeline.statistics().last_new, i);
  }
  const auto& statistics = pipeline.statistics();
  EXPECT_EQ(statistics.sequence.accepted, 3u);
  EXPECT_EQ(statistics.sequence.duplicates, 0u);
  EXPECT_EQ(statistics.without_counter, 3u);

  // A counter that comes after all is judged as the first one.
  EXPECT_TRUE(pipeline.process(sample(params(7), today + 3 * field), 0).pose);
  EXPECT_FALSE(pipeline.process(sample(params(7), today + 4 * field), 0).pose);
  EXPECT_EQ(statistics.sequence.accepted, 4u);
  EXPECT_EQ(statistics.sequence.duplicates, 1u);
}

TEST(CameraPipeline, WithoutALensOnlyThePoseIsPublished) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  ASSERT_TRUE(pipeline.process(sample(params(1)), 0).calibration);
  auto p = params(2);
  p.fov = std::nan("");  // says nothing
  auto s = sample(p, today + field);
  s.has_lens = false;
  const auto made = pipeline.process(s, 0);
  ASSERT_TRUE(made.pose);
  EXPECT_EQ(made.pose->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(made.stamp, today + field);
  EXPECT_FALSE(made.params || made.calibration || made.constants);
  const auto& statistics = pipeline.statistics();
  EXPECT_EQ(statistics.sequence.accepted, 2u);
  EXPECT_EQ(statistics.without_lens, 1u);
  EXPECT_FALSE(statistics.has_lens);
  EXPECT_FALSE(statistics.has_camera_info);
  EXPECT_EQ(statistics.dropped + statistics.withheld + statistics.without_camera_info, 0u);

  EXPECT_TRUE(pipeline.process(sample(params(3), today + 2 * field), 0).calibration);
  EXPECT_TRUE(statistics.has_lens);
}

TEST(CameraPipeline, APoseThatIsNoneIsDroppedWithoutALensAsWell) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto p = params(1);
  p.euler.x = std::nan("");
  auto s = sample(p);
  s.has_lens = false;
  EXPECT_FALSE(pipeline.process(s, 0).pose);
  EXPECT_EQ(pipeline.statistics().dropped, 1u);
}

/// 250 fields at 50 Hz: `counter_of` gives a field's counter. Every field has a pose of its own, x. Gives those
/// published, in their order.
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

TEST(CameraPipeline, NoCounterFreezesASenderOfFreshValues) {
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

    // The same with a camera that stands still: only how many are published can be seen.
    CameraPipeline still(CameraOptions{}, 50);
    std::size_t count_still = 0;
    for (int i = 0; i < 250; ++i) {
      if (still.process(sample(params(c.counter_of(i)), today + i * field), i * field).pose) ++count_still;
    }
    EXPECT_GE(count_still, c.least) << c.name << ", standing still";
  }
}

TEST(CameraPipeline, AStrictCounterRulesWhateverItDoes) {
  CameraOptions strict;
  strict.counter = base::CounterUse::strict;
  CameraPipeline stands(strict, 50), circles(strict, 50);
  EXPECT_EQ(published_of([](int) { return 0; }, all_fields(), stands).size(), 1u);
  EXPECT_EQ(published_of([](int i) { return i % 30; }, all_fields(), circles).size(), 30u);
}

TEST(CameraPipeline, EveryFieldOnceWhenEverySecondComesTwice) {
  std::vector<int> fields;
  for (const int i : all_fields()) fields.insert(fields.end(), i % 2 == 0 ? 1 : 2, i);
  CameraPipeline pipeline(CameraOptions{}, 50);
  EXPECT_EQ(published_of([](int i) { return i; }, fields, pipeline), all_fields());
  EXPECT_EQ(pipeline.statistics().sequence.duplicates, 125u);
  EXPECT_EQ(pipeline.statistics().sequence.state, base::CounterState::counts);
}

TEST(CameraPipeline, LateFieldsAreNeverPublishedOutOfOrder) {
  for (int by = 1; by <= 8; ++by) {
    // Every tenth field comes `by` places later; then one field before `by` others.
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

TEST(CameraPipeline, OnlyTheFirstSenderIsFollowedUntilItIsSilent) {
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
  EXPECT_FALSE(pipeline.process(sample_from(1000, 5000, now), now).pose) << "it comes back";
}

TEST(CameraPipeline, ForgedRecordsOfAnotherPortAreIgnoredAndOfTheSameCostLittle) {
  for (const std::uint32_t port : {1000u, 2000u}) {
    CameraPipeline pipeline(CameraOptions{}, 50);
    int good = 0, forged = 0;
    std::int64_t now = 0;
    for (std::uint64_t i = 0; i < 260; ++i, now += field) {
      if (pipeline.process(sample_from(1000, i, now), now).pose) ++good;
      if (i % 25 == 10 && pipeline.process(sample_from(port, i + 49, now + 1), now + 1).pose) ++forged;
    }
    EXPECT_EQ(good, 260) << port;
    // From the very same port nothing can tell them apart.
    if (port != 1000) {
      EXPECT_EQ(forged, 0);
    }
  }
}

TEST(CameraPipeline, ConstantsOfAForeignSenderAreIgnored) {
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

TEST(CameraPipeline, ASenderOfNoCameraCannotTakeItFromOthers) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto bad = sample_from(2000, 1, 0);
  std::get<wire::CameraParams>(bad.record).euler.pan = std::nan("");
  EXPECT_FALSE(pipeline.process(bad, 0).pose);
  EXPECT_TRUE(pipeline.process(sample_from(1000, 1, 1), 1).pose) << "it does not hold the camera";
  // A holder that sends nothing but such records is silent.
  bad.sender.number = 1000;
  for (std::int64_t now = 2; now < second; now += field) EXPECT_FALSE(pipeline.process(bad, now).pose);
  EXPECT_TRUE(pipeline.process(sample_from(2000, 1, second), second).pose);
}

TEST(CameraPipeline, ASenderWithANewPortForEveryDatagramIsFollowed) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  int published = 0;
  for (std::uint32_t i = 0; i < 250; ++i) {
    if (pipeline.process(sample_from(40000 + i, i, i * field), i * field).pose) ++published;
  }
  EXPECT_EQ(published, 250 - static_cast<int>(SenderLock::most_ports));
  EXPECT_TRUE(pipeline.statistics().ignores_ports);
}

TEST(CameraPipeline, WithoutFailoverEverySenderIsFollowed) {
  CameraOptions options;
  options.failover = 0;
  CameraPipeline pipeline(options, 50);
  EXPECT_TRUE(pipeline.process(sample_from(1000, 1, 0), 0).pose);
  EXPECT_TRUE(pipeline.process(sample_from(2000, 1, 1), 1).pose);
  EXPECT_TRUE(pipeline.process(sample_from(1000, 2, 2), 2).pose);
}

TEST(CameraPipeline, KeepsTheEncodingAndSenderOfTheLastNewRecord) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto s = sample(params(1));
  s.origin = "binary identified_lp64, layout guessed";
  s.sender.number = 50123;
  (void)pipeline.process(s, 0);
  s.origin = "ASCII";
  s.sender.number = 50124;
  (void)pipeline.process(s, 0);
  EXPECT_STREQ(pipeline.statistics().encoding, "binary identified_lp64, layout guessed") << "a duplicate came later";
  EXPECT_EQ(pipeline.statistics().sender.number, 50123u);
}

TEST(CameraPipeline, ATimeOutsideOfRosTimeIsDropped) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  EXPECT_FALSE(pipeline.process(sample(params(1), -1), 0).pose);
  EXPECT_EQ(pipeline.statistics().unstampable, 1u);
  EXPECT_TRUE(pipeline.process(sample(params(2)), 0).pose);
}

}  // namespace
}  // namespace trk_bridge::bridge
