// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/transform_filter.h"

#include <gmock/gmock.h>

namespace trk_bridge::bridge::transform_filter_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t field = second / 50;
constexpr std::int64_t start = 1'700'000'000 * second;

/// The poses of `camera` in `studio`, through `rail`, received at 50 Hz.
class TransformFilterTest : public ::testing::Test {
 protected:
  using Verdict = TransformFilter::Verdict;

  TransformFilterTest() { filter.add_static("studio", "rail"); }

  Verdict classify(const std::string& child, std::int64_t stamp) {
    const std::string parent = child == "camera" ? "rail" : "elsewhere";
    return filter.classify({parent, child, stamp, "/driver"}, start + now, now);
  }
  /// One field later, a transform with a clock error of `offset`.
  Verdict next(std::int64_t offset = 0, const std::string& child = "camera") {
    now += field;
    return classify(child, start + now + offset);
  }
  /// How many fields in a row the filter refuses.
  int refused_in_a_row(std::int64_t offset, const std::string& child = "camera", int most = 1000) {
    for (int count = 0; count < most; ++count) {
      if (next(offset, child) != Verdict::refuse) return count;
    }
    return most;
  }

  TransformFilter filter{"studio", "camera"};
  std::int64_t now = 0;  // ns of the steady clock; ROS time began at `start`
};

TEST_F(TransformFilterTest, TransformsInTimeAreUsed) {
  for (int n = 0; n < 100; ++n) EXPECT_EQ(next(), Verdict::use);
  EXPECT_EQ(classify("camera", start + now - second / 2), Verdict::use) << "late";
  EXPECT_EQ(classify("camera", start + now + second / 2), Verdict::use) << "dated ahead by its publisher";
  EXPECT_EQ(filter.statistics().refused, 0u);
}

TEST_F(TransformFilterTest, ATransformFarAheadIsRefused) {
  for (int n = 0; n < 200; ++n) {
    EXPECT_EQ(next(), Verdict::use);
    EXPECT_EQ(classify("camera", start + 1'000'000 * second), Verdict::refuse);
  }
  EXPECT_EQ(filter.statistics().refused, 200u);
  EXPECT_EQ(filter.statistics().restarts, 0u);
  EXPECT_THAT(describe(filter.statistics().last_refused),
              AllOf(HasSubstr("frame camera from /driver are "), HasSubstr(" s ahead of ROS time")));
}

TEST_F(TransformFilterTest, AClockThatIsSetIsFollowedWithinASecond) {
  for (const std::int64_t offset : {3600 * second, 0L, -60 * second, -63 * second, 1'000'000 * second, 0L}) {
    const auto restarts = filter.statistics().restarts;
    EXPECT_LE(refused_in_a_row(offset) * field, second / 2) << offset;
    for (int n = 0; n < 100; ++n) ASSERT_EQ(next(offset), Verdict::use) << offset << ", " << n;
    EXPECT_EQ(filter.statistics().restarts, restarts + 1) << offset;
  }
  EXPECT_THAT(describe(filter.statistics().last_restart),
              HasSubstr("frame camera from /driver went back by 1000000.0 s"));
}

TEST_F(TransformFilterTest, AClockThatIsAheadFromTheStartIsFollowed) {
  EXPECT_LE(refused_in_a_row(3600 * second) * field, second / 2);
  for (int n = 0; n < 100; ++n) EXPECT_EQ(next(3600 * second), Verdict::use);
  EXPECT_EQ(classify("camera", start + now + 7200 * second), Verdict::refuse) << "also ahead of that clock";
}

TEST_F(TransformFilterTest, AllLinksOfOneClockStartOverOnce) {
  TransformFilter chain{"studio", "camera"};
  const auto both = [&](std::int64_t offset) {
    now += field;
    const auto arm = chain.classify({"studio", "arm", start + now + offset, "/driver"}, start + now, now);
    return std::pair{arm, chain.classify({"arm", "camera", start + now + offset, "/driver"}, start + now, now)};
  };
  const std::pair in_time{Verdict::use, Verdict::use};
  for (int n = 0; n < 10; ++n) EXPECT_EQ(both(0), in_time);
  for (const std::int64_t offset : {3600 * second, -60 * second}) {
    while (both(offset) != in_time) ASSERT_LT(now, 10 * second);
  }
  EXPECT_EQ(chain.statistics().restarts, 2u);
}

TEST_F(TransformFilterTest, UnrelatedLinksDoNotRestart) {
  for (int n = 0; n < 10; ++n) EXPECT_EQ(next(0, "robot"), Verdict::use);
  EXPECT_EQ(refused_in_a_row(-60 * second, "robot", 100), 100);
  EXPECT_EQ(filter.statistics().restarts, 0u);
  EXPECT_EQ(filter.statistics().refused, 0u);
  // Now the camera is attached to it.
  now += field;
  EXPECT_EQ(filter.classify({"robot", "camera", start + now, "/driver"}, start + now, now), Verdict::use);
  EXPECT_EQ(next(-60 * second, "robot"), Verdict::restart);
}

TEST_F(TransformFilterTest, ALoopOfFramesDoesNotHang) {
  EXPECT_EQ(filter.classify({"b", "camera", start, "/driver"}, start, now), Verdict::use);
  EXPECT_EQ(filter.classify({"camera", "b", start, "/driver"}, start, now), Verdict::use);
  EXPECT_EQ(classify("robot", start + 60 * second), Verdict::refuse);
}

TEST_F(TransformFilterTest, RosTimeThatGoesBackRestartsAtOnce) {
  EXPECT_FALSE(filter.ros_time_went_back(start));
  EXPECT_FALSE(filter.ros_time_went_back(start - second / 2));
  EXPECT_FALSE(filter.ros_time_went_back(start + 100 * second));
  EXPECT_EQ(filter.classify({"studio", "camera", start + 100 * second, "/driver"}, start + 100 * second, now),
            Verdict::use);
  EXPECT_TRUE(filter.ros_time_went_back(start));
  EXPECT_FALSE(filter.ros_time_went_back(start));
  EXPECT_EQ(filter.classify({"studio", "camera", start, "/driver"}, start, now), Verdict::use);
  EXPECT_EQ(describe(filter.statistics().last_restart), "ROS time went back by 100.0 s");
}

}  // namespace trk_bridge::bridge::transform_filter_test
