// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tools/detected.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "camera_records.h"
#include "memory_feed.h"

namespace trk_bridge::tools::detected_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A camera that has sent two sets, one second apart.
Detected found(const wire::CameraParams& first, const wire::CameraParams& last, bool with_constants = true) {
  using std::chrono::seconds;
  const test::MemoryFeed feed;
  const monitor::Model::Time begin{std::chrono::hours(1)};
  monitor::Model model(begin);
  Detected one;
  one.protocol = "trk";
  one.place = "udp port 7000 on every interface";
  one.source = "udp://:7000";
  const auto add = [&](const wire::Record& record, int second) {
    transport::Sample sample;
    sample.record = record;
    sample.arrival = second * 1'000'000'000LL;
    sample.sender = test::MemoryFeed::sender(5000);
    sample.origin = "ASCII";
    model.add(sample, begin + seconds(second));
  };
  if (with_constants) add(test::constants(720, first.id), 0);
  add(first, 0);
  add(last, 1);
  one.camera = model.state(begin + seconds(1), *feed.source()).cameras.front();
  for (const auto& params : {first, last}) {
    if (const auto pose = camera::decode_pose(params)) one.motion.add(*pose);
  }
  return one;
}

Detected found(const wire::CameraParams& params) {
  auto next = params;
  ++next.counter;
  return found(params, next);
}

TEST(Detected, ACameraInAStudioIsPlausible) {
  const auto one = found(test::params(1, 3));
  EXPECT_THAT(doubts_of(one), IsEmpty());
  const auto lines = lines_of(one);
  EXPECT_THAT(lines, Contains("  axes      plausible"));
  EXPECT_THAT(lines, Contains("  position  x 1.50, y -2.00, height 1.75 m"));
  EXPECT_THAT(lines, Contains("  angles    pan 30.0, tilt -5.0, roll 0.2 degrees"));
  EXPECT_THAT(lines, Contains("  rate      1.00 Hz; 2 records, none lost"));
  // 2 atan(8.8 / 2 / 42)
  EXPECT_THAT(lines,
              Contains(HasSubstr("horizontal angle of view 11.96 degrees, focus 4.50 m; image 720 x 576 pixels")));
  EXPECT_THAT(lines, Contains(HasSubstr("nothing moved")));
  EXPECT_EQ(lines.back(), "  launch    roslaunch trk_bridge trk_to_ros.launch source:=\"udp://:7000\" camera:=camera3");
}

TEST(Detected, ImplausibleValuesAreNamed) {
  const auto doubt = [](auto change) {
    auto params = test::params(1);
    change(params);
    return doubts_of(found(params));
  };
  EXPECT_THAT(doubt([](auto& p) { p.euler.x = 1500; }), ElementsAre(HasSubstr("1500 m from the origin")));
  EXPECT_THAT(doubt([](auto& p) { p.euler.z = -2.5; }), ElementsAre(HasSubstr("the height is -2.50 m")));
  EXPECT_THAT(doubt([](auto& p) { p.euler.x = p.euler.y = p.euler.z = 0; }),
              ElementsAre(HasSubstr("the position is always 0 0 0")));
  EXPECT_THAT(doubt([](auto& p) { p.euler.roll = -90; }), ElementsAre(HasSubstr("rolled by -90.0 degrees")));
  EXPECT_THAT(doubt([](auto& p) { p.euler.tilt = 88; }), ElementsAre(HasSubstr("tilted by 88.0 degrees")));
  EXPECT_THAT(doubt([](auto& p) { p.fov = 0.9; }), ElementsAre(HasSubstr("angle of view is 156.88 degrees")));
  EXPECT_THAT(doubt([](auto& p) { p.fov = 5000; }), ElementsAre(HasSubstr("angle of view is 0.10 degrees")));
  EXPECT_THAT(doubt([](auto& p) { p.euler.pan = std::numeric_limits<double>::infinity(); }),
              ElementsAre(HasSubstr("no pose")));
}

TEST(Detected, ALostRecordIsADoubt) {
  EXPECT_THAT(doubts_of(found(test::params(1), test::params(4))), ElementsAre("2 records were lost"));
}

TEST(Detected, APanThatContinuesBeyondHalfATurnIsOneRange) {
  Motion motion;
  for (const double pan : {170.0, 179.0, -175.0, -165.0}) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = camera::rotation_of({pan, 0, 0});
    motion.add(pose);
  }
  EXPECT_NEAR(motion.pan.least, 170, 1e-9);
  EXPECT_NEAR(motion.pan.most, 195, 1e-9);
}

TEST(Detected, MotionIsReportedWithItsSigns) {
  auto panned = test::params(2);
  panned.euler.pan = 45;
  const auto lines = lines_of(found(test::params(1), panned));
  EXPECT_THAT(lines, Contains("  angles    pan 30.0 to 45.0, tilt -5.0, roll 0.2 degrees"));
  EXPECT_THAT(lines, Contains(HasSubstr("right if pan to the left")));
}

TEST(Detected, MissingConstantsAndSeveralCamerasAreNamed) {
  auto one = found(test::params(1, 3), test::params(2, 3), /*with_constants=*/false);
  one.needs_id = one.is_shared = true;
  one.other_options = "checksum=lenient";
  EXPECT_THAT(lines_of(one), Contains(HasSubstr("CameraInfo needs them")));
  EXPECT_THAT(lines_of(one), Contains(HasSubstr("image distance 42.000 mm")));
  EXPECT_THAT(launch_line(one), HasSubstr(" id:=3"));
  EXPECT_THAT(doubts_of(one), ElementsAre(HasSubstr("only checksum=lenient accepts"), HasSubstr("allow=ADDRESS")));
}

}  // namespace trk_bridge::tools::detected_test
