// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Which messages are kept, and which of them is drawn.
#include "rviz/samples.h"

#include <limits>

#include <gmock/gmock.h>
#include <sensor_msgs/CameraInfo.h>
#include <boost/make_shared.hpp>

namespace trk_bridge::rviz_display::samples_test {

using sensor_msgs::CameraInfo;
using InfoSamples = Samples<CameraInfo>;

InfoSamples::Ptr info(const ros::Time& stamp, std::uint32_t mark = 0) {
  const auto message = boost::make_shared<CameraInfo>();
  message->header.stamp = stamp;
  message->width = mark;
  return message;
}

InfoSamples::Ptr info(double seconds, std::uint32_t mark = 0) { return info(ros::Time(seconds), mark); }

bool any(const CameraInfo& /*info*/) { return true; }

double stamp_of(const InfoSamples::Ptr& sample) { return sample ? sample->header.stamp.toSec() : -1; }

TEST(Samples, NewestUsableIsChosenWhateverTheOrderOfArrival) {
  InfoSamples samples;
  for (const double time : {10.0, 10.3, 10.1, 10.2}) samples.add(info(time));
  EXPECT_EQ(stamp_of(samples.newest(any)), 10.3);
  const auto older = [](const CameraInfo& message) { return message.header.stamp < ros::Time(10.25); };
  EXPECT_EQ(stamp_of(samples.newest(older)), 10.2);
  EXPECT_EQ(samples.newest([](const CameraInfo&) { return false; }), nullptr);
}

TEST(Samples, NewerOnesAreTriedFirst) {
  InfoSamples samples;
  for (const double time : {10.0, 10.2, 10.1}) samples.add(info(time));
  std::vector<double> asked;
  EXPECT_EQ(samples.newest([&](const CameraInfo& message) {
    asked.push_back(message.header.stamp.toSec());
    return false;
  }),
            nullptr);
  EXPECT_THAT(asked, testing::ElementsAre(10.2, 10.1, 10.0));
}

TEST(Samples, HalfASecondIsKept) {
  InfoSamples samples;
  for (int i = 0; i <= 120; ++i) EXPECT_EQ(samples.add(info(100 + i / 120.0)), Added::in_time);
  EXPECT_EQ(samples.size(), 61u);
}

TEST(Samples, TwoAreKeptOfASlowCamera) {
  InfoSamples samples;
  for (const double time : {10.0, 20.0, 30.0}) samples.add(info(time));
  EXPECT_EQ(samples.size(), 2u);
  EXPECT_EQ(stamp_of(samples.newest([](const CameraInfo& message) { return message.header.stamp < ros::Time(30); })),
            20);
}

TEST(Samples, TheirNumberIsLimited) {
  InfoSamples samples;
  for (int i = 0; i < 10000; ++i) samples.add(info(100 + i * 1e-5));
  EXPECT_EQ(samples.size(), InfoSamples::most);
  EXPECT_NEAR(stamp_of(samples.newest()), 100.09999, 1e-6);
}

TEST(Samples, StartAgainWhenTimeGoesBackBeyondTheWindow) {
  InfoSamples samples;
  samples.add(info(100.0));
  samples.add(info(100.4));
  EXPECT_EQ(samples.add(info(99.91)), Added::in_time) << "late by less than the window";
  EXPECT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples.add(info(50.0)), Added::restarted);
  EXPECT_EQ(samples.size(), 1u);
  EXPECT_EQ(stamp_of(samples.newest()), 50);
}

TEST(Samples, EqualStampsReplaceEachOther) {
  InfoSamples samples;
  samples.add(info(10.0, 1));
  samples.add(info(10.1, 2));
  EXPECT_EQ(samples.add(info(10.0, 3)), Added::in_time);
  EXPECT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples.belonging_to(ros::Time(10.0))->width, 3u);
}

TEST(Samples, ZeroStampMeansNowAndReplacesAll) {
  InfoSamples samples;
  samples.add(info(10.0, 1));
  EXPECT_EQ(samples.add(info(0.0, 2)), Added::in_time);
  EXPECT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples.add(info(0.0, 3)), Added::in_time);
  EXPECT_EQ(samples.newest()->width, 3u);
  EXPECT_EQ(samples.add(info(11.0, 4)), Added::in_time) << "not a jump back";
  EXPECT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples.newest()->width, 4u);
}

TEST(Samples, AbsurdStampsDoNoHarmAndAreReplaced) {
  ros::Time beyond;  // not normalised, which is possible in a message
  beyond.sec = beyond.nsec = std::numeric_limits<std::uint32_t>::max();
  ros::Time early;
  early.nsec = 1;
  InfoSamples samples;
  samples.add(info(early));
  EXPECT_EQ(samples.add(info(beyond)), Added::in_time);
  EXPECT_EQ(samples.newest()->header.stamp, beyond);
  EXPECT_EQ(samples.add(info(1.7e9)), Added::restarted);
  EXPECT_EQ(samples.add(info(1.7e9 + 0.01)), Added::in_time);
  EXPECT_EQ(samples.size(), 2u);
  EXPECT_GT(seconds_between(early, beyond), 4.2e9);
  EXPECT_LT(seconds_between(beyond, early), -4.2e9);
}

TEST(Samples, BelongingToIsTheSameStampElseTheNewestBeforeElseTheFirstAfter) {
  InfoSamples samples;
  EXPECT_EQ(samples.belonging_to(ros::Time(1)), nullptr);
  for (const double time : {10.0, 10.2, 10.4}) samples.add(info(time));
  EXPECT_EQ(stamp_of(samples.belonging_to(ros::Time(10.2))), 10.2);
  EXPECT_EQ(stamp_of(samples.belonging_to(ros::Time(10.3))), 10.2);
  EXPECT_EQ(stamp_of(samples.belonging_to(ros::Time(99))), 10.4);
  EXPECT_EQ(stamp_of(samples.belonging_to(ros::Time(9.9))), 10.0);
  EXPECT_EQ(stamp_of(samples.belonging_to(ros::Time())), 10.4);
}

}  // namespace trk_bridge::rviz_display::samples_test
