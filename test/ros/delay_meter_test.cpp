// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The node delay_meter: from topics to a delay and diagnostics.
#include <optional>
#include <string>

#include <ros/callback_queue.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float64.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "card_video.h"
#include "fixture.h"
#include "nodes/delay_meter.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::test::delay_meter_test {

using ::testing::HasSubstr;

constexpr double true_delay = 0.033;  // s
constexpr double begin = 5000;        // s, of stamps, which need not be the current time

class DelayMeter : public NodeTest<nodes::DelayMeter> {
 protected:
  DelayMeter() : NodeTest("delay_meter") {}

  void advertise() {
    ::ros::NodeHandle topics(name_space);
    constants_ = topics.advertise<trk_bridge::CameraConstants>("constants", 1, /*latch=*/true);
    params_ = topics.advertise<trk_bridge::CameraParams>("params", 1000);
    images_ = topics.advertise<sensor_msgs::Image>("image", 1000);
    trk_bridge::CameraConstants message;
    ros1::to_msg(video_constants(), message);
    constants_.publish(message);
    ASSERT_TRUE(eventually([&] { return params_.getNumSubscribers() > 0 && images_.getNumSubscribers() > 0; }));
  }

  /// One sample of tracking and, if one is due, a frame of 25 Hz that shows the camera with a delay.
  void publish(int field) {
    const double t = field / 50.0 - 1.2;
    trk_bridge::CameraParams params;
    ros1::to_msg(quick_pans(t), params);
    params.header.stamp = ::ros::Time(begin + t);
    params_.publish(params);
    if (field % 2 != 0 || t < 0 || t > quick_pans_end) return;
    const cv::Mat picture = video_.frame(quick_pans(t), t);
    sensor_msgs::Image image;
    image.header.stamp = ::ros::Time(begin + t + true_delay);
    image.width = image.step = static_cast<std::uint32_t>(picture.cols);
    image.height = static_cast<std::uint32_t>(picture.rows);
    image.encoding = "mono8";
    image.data.assign(picture.datastart, picture.dataend);
    images_.publish(image);
    ++frames_;
  }

  ::testing::AssertionResult took_all_frames() {
    return diagnostics.becomes(status_name(), "messages of " + name_space + "/image", std::to_string(frames_));
  }

  CardVideo video_;
  ::ros::Publisher constants_, params_, images_;
  int frames_ = 0;
};

TEST_F(DelayMeter, MeasuresTheDelayAndReportsItUntilThereIsAnother) {
  const LogRecorder log;
  ASSERT_TRUE(starts());
  EXPECT_TRUE(eventually([&] {
    return log.has("waiting for pictures on " + name_space + "/image, and for " + name_space + "/params and " +
                   name_space + "/constants");
  })) << "users see in the log what it waits for";
  EXPECT_TRUE(diagnostics.reports(status_name(), 1, "nothing on " + name_space + "/params"));
  advertise();
  Recorder<std_msgs::Float64> delays(node_name + "/delay");
  for (int field = 0; field < 50 * (quick_pans_end + 2); ++field) {
    publish(field);
    // Not more than its queue can hold.
    eventually([] { return true; });
    ::ros::getGlobalCallbackQueue()->callAvailable();
  }
  ASSERT_TRUE(eventually([&] { return !delays.messages.empty(); }));
  // It may have measured a part while it received the rest.
  ASSERT_TRUE(took_all_frames());
  const std::size_t measured = delays.messages.size();
  ASSERT_TRUE(eventually([&] { return delays.messages.size() > measured; }));
  EXPECT_NEAR(delays.messages.back().data, true_delay, 0.001);
  EXPECT_TRUE(diagnostics.reports(status_name(), 0, "the video is 33."));
  EXPECT_THAT(diagnostics.value(status_name(), "setting"), HasSubstr("for ros_to_trk: delay:=0.033"));
  EXPECT_EQ(diagnostics.value(status_name(), "video (Hz)"), "25.00");

  // Invalid pictures are counted and reported.
  sensor_msgs::Image image;
  image.header.stamp = ::ros::Time(begin + 100);
  image.encoding = "sepia";
  images_.publish(image);
  EXPECT_TRUE(diagnostics.becomes(status_name(), "left out of " + name_space + "/image", "1"));
}

TEST_F(DelayMeter, WrongParametersAreRefused) {
  set("window", 1000);
  EXPECT_THAT(refusal(), HasSubstr("~window = 1000: must be 4 to 120 seconds"));
}

}  // namespace trk_bridge::test::delay_meter_test
