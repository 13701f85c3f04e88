// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What can be changed while a node runs.
#include <future>
#include <string>

#include <sensor_msgs/CameraInfo.h>
#include <std_srvs/SetBool.h>
#include <trk_bridge/CameraParams.h>
#include <trk_bridge/SetSeconds.h>

#include "camera_records.h"
#include "fixture.h"
#include "params_publisher.h"
#include "receiver.h"
#include "repeating.h"

namespace trk_bridge::test::services_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The response of a service of the node, whose callbacks are called meanwhile.
template <typename Service, typename Value>
typename Service::Response call(const std::string& name, const Value& value) {
  Service service;
  if constexpr (std::is_same_v<Service, std_srvs::SetBool>) {
    service.request.data = value;
  } else {
    service.request.seconds = value;
  }
  auto called = std::async(std::launch::async, [&] { return ::ros::service::call(name, service); });
  EXPECT_TRUE(eventually([&] { return called.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
  EXPECT_TRUE(called.get()) << name;
  return service.response;
}

std::string refusal_of(const std::string& name, double seconds) {
  const auto response = call<trk_bridge::SetSeconds>(name, seconds);
  EXPECT_FALSE(response.success);
  return response.message;
}

class LiveInput : public TrkToRosTest {
 protected:
  void SetUp() override { set("source", any_udp_port); }
};

TEST_F(LiveInput, TheDelayOfStampsCanBeChangedLive) {
  set("stamp", "arrival");
  ASSERT_TRUE(starts());
  const Tracker tracker(port());
  Recorder<trk_bridge::CameraParams> recorder(name_space + "/params");
  std::uint64_t counter = 0;
  // Only the test knows the later of now and the stamp: the node has stamped the record before.
  const auto age = [&] {
    const auto count = recorder.messages.size();
    tracker.send(params(++counter));
    EXPECT_TRUE(eventually([&] { return recorder.messages.size() > count; }));
    return (::ros::Time::now() - recorder.messages.back().header.stamp).toSec();
  };
  ASSERT_TRUE(eventually([&] {
    tracker.send(params(++counter));
    return !recorder.messages.empty();
  }));
  const auto response = call<trk_bridge::SetSeconds>(node_name + "/set_delay", 0.75);
  EXPECT_TRUE(response.success);
  EXPECT_THAT(response.message, HasSubstr("0.75 s earlier"));
  ASSERT_TRUE(eventually([&] { return age() >= 0.75; }));
  EXPECT_TRUE(call<trk_bridge::SetSeconds>(node_name + "/set_delay", 0.0).success);
  ASSERT_TRUE(eventually([&] { return age() < 0.7; }));
  EXPECT_THAT(refusal_of(node_name + "/set_delay", -1), HasSubstr("set_delay = -1: must be 0 to 60 seconds"));
  EXPECT_THAT(refusal_of(node_name + "/set_delay", std::nan("")), HasSubstr("must be 0 to 60 seconds"));
}

TEST_F(LiveInput, WhatIsPublishedCanBeSwitchedOffAndOnAgain) {
  ASSERT_TRUE(starts());
  const Tracker tracker(port());
  Recorder<trk_bridge::CameraParams> recorder(name_space + "/params");
  Recorder<sensor_msgs::CameraInfo> infos(name_space + "/camera_info");
  TransformRecorder transforms("/tf", camera);
  std::uint64_t counter = 0;
  const auto send = [&] {
    const auto count = recorder.messages.size();
    tracker.send(constants());
    tracker.send(params(++counter));
    EXPECT_TRUE(eventually([&] { return recorder.messages.size() > count; }));
  };
  ASSERT_TRUE(eventually([&] {
    send();
    return !infos.messages.empty() && !transforms.transforms.empty();
  }));
  EXPECT_TRUE(call<std_srvs::SetBool>(node_name + "/set_publish_tf", false).success);
  EXPECT_TRUE(call<std_srvs::SetBool>(node_name + "/set_publish_camera_info", false).success);
  send();
  send();
  const auto info_count = infos.messages.size(), transform_count = transforms.transforms.size();
  for (int i = 0; i < 5; ++i) send();
  EXPECT_EQ(infos.messages.size(), info_count);
  EXPECT_EQ(transforms.transforms.size(), transform_count);
  EXPECT_TRUE(call<std_srvs::SetBool>(node_name + "/set_publish_tf", true).success);
  EXPECT_TRUE(call<std_srvs::SetBool>(node_name + "/set_publish_camera_info", true).success);
  ASSERT_TRUE(eventually([&] {
    send();
    return infos.messages.size() > info_count && transforms.transforms.size() > transform_count;
  }));
}

TEST_F(LiveInput, OutputsDisabledAtStartCannotBeSwitchedOn) {
  set("publish_tf", false);
  ASSERT_TRUE(starts());
  const auto response = call<std_srvs::SetBool>(node_name + "/set_publish_tf", true);
  EXPECT_FALSE(response.success);
  EXPECT_THAT(response.message, HasSubstr("publish_tf was false when the node started"));
}

class LiveOutput : public RosToTrkTest {};

TEST_F(LiveOutput, DelayAndLeadCanBeChangedIfATimerSends) {
  const Receiver receiver, with_own;
  set_sinks({receiver.url(), with_own.url() + "?delay=0.01"});
  set("pace", true);
  ASSERT_TRUE(starts());
  EXPECT_THAT(call<trk_bridge::SetSeconds>(node_name + "/set_delay", 0.0365).message, HasSubstr("delay 0.0365 s"));
  EXPECT_THAT(call<trk_bridge::SetSeconds>(node_name + "/set_lead", 0.02).message,
              AllOf(HasSubstr("delay 0.0365 s"), HasSubstr("lead 0.02 s")));
  EXPECT_THAT(refusal_of(node_name + "/set_delay", 1.5), HasSubstr("must be 0 to 1 seconds"));
  EXPECT_THAT(refusal_of(node_name + "/set_lead", 0.1), HasSubstr("must be 0 to 0.04 seconds"));
}

TEST_F(LiveOutput, WithoutATimerTheReasonIsGiven) {
  const Receiver receiver;
  set_sinks({receiver.url()});
  ASSERT_TRUE(starts());
  EXPECT_THAT(refusal_of(node_name + "/set_delay", 0.02), HasSubstr("start the node with pace"));
}

}  // namespace trk_bridge::test::services_test
