// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The launch files, included by the test's launch file with a take that is repeated for ever, and a nodelet manager.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <trk_bridge/CameraParams.h>
#include <visualization_msgs/MarkerArray.h>

#include "fixture.h"
#include "reserved_port.h"
#include "roslaunch.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::test::launched_test {

/// The nodes run from the first test that needs them to the end of the program.
class LaunchedNodes : public ::testing::Environment {
 public:
  void start() {
    if (!roslaunch_) roslaunch_.emplace(std::vector<std::string>{LAUNCH_FILE});
  }
  void TearDown() override { roslaunch_.reset(); }

 private:
  std::optional<Roslaunch> roslaunch_;
};

auto* const launched_nodes = new LaunchedNodes;
const auto* const registered = ::testing::AddGlobalTestEnvironment(launched_nodes);

class Launched : public ::testing::TestWithParam<const char*> {
 protected:
  Launched() { launched_nodes->start(); }
};
class LaunchedMarkers : public ::testing::Test {
 protected:
  LaunchedMarkers() { launched_nodes->start(); }
};

TEST_P(Launched, PublishesInTheNamespaceOfItsCamera) {
  const std::string camera = GetParam();
  Recorder<trk_bridge::CameraParams> params("/" + camera + "/params");
  TransformRecorder transforms("/tf", camera);
  TransformRecorder statics("/tf_static", camera + "_optical");
  ASSERT_TRUE(eventually(
      [&] { return params.messages.size() > 2 && transforms.transforms.size() > 2 && !statics.transforms.empty(); }));
  EXPECT_EQ(params.messages.front().header.frame_id, "stage");
  EXPECT_EQ(transforms.transforms.front().header.frame_id, "stage");
  EXPECT_EQ(statics.transforms.front().header.frame_id, camera);
  for (std::size_t i = 1; i < transforms.transforms.size(); ++i) {
    EXPECT_GT(transforms.transforms[i].header.stamp, transforms.transforms[i - 1].header.stamp);
  }
}

TEST_F(LaunchedMarkers, AreDrawnIfRequested) {
  Recorder<visualization_msgs::MarkerArray> markers("/launched_nodelet/trk_to_ros/markers");
  ASSERT_TRUE(eventually([&] { return !markers.messages.empty(); }));
  const auto& axis = markers.messages.front().markers.at(1);
  EXPECT_EQ(axis.ns, "launched_nodelet/axis");
  EXPECT_EQ(axis.points.back().z, 5);
  // Once it publishes, all its topics are advertised.
  Recorder<trk_bridge::CameraParams> params("/launched_node/params");
  ASSERT_TRUE(eventually([&] { return !params.messages.empty(); }));
  EXPECT_FALSE(is_advertised("/launched_node/trk_to_ros/markers"));
}

INSTANTIATE_TEST_SUITE_P(As, Launched, ::testing::Values("launched_node", "launched_nodelet"),
                         [](const auto& test) { return std::string(test.param); });

class InManager : public CameraTest {
 protected:
  explicit InManager(const std::string& node, std::string type) : CameraTest(node), type_(std::move(type)) {
    launched_nodes->start();
  }

  bool load() {
    nodelet::NodeletLoad request;
    request.request.name = node_name;
    request.request.type = type_;
    request.request.remap_source_args = {"/diagnostics"};
    request.request.remap_target_args = {diagnostics.topic()};
    EXPECT_TRUE(::ros::service::waitForService("/manager/load_nodelet", ::ros::Duration(deadline.count())));
    return ::ros::service::call("/manager/load_nodelet", request) && request.response.success;
  }
  bool unload() {
    nodelet::NodeletUnload request;
    request.request.name = node_name;
    return ::ros::service::call("/manager/unload_nodelet", request) && request.response.success;
  }

 private:
  std::string type_;
};

class TrkToRosInManager : public InManager {
 protected:
  TrkToRosInManager() : InManager("trk_to_ros", "trk_bridge/TrkToRos") {}
};

class RosToTrkInManager : public InManager {
 protected:
  RosToTrkInManager() : InManager("ros_to_trk", "trk_bridge/RosToTrk") {}
};

class DelayMeterInManager : public InManager {
 protected:
  DelayMeterInManager() : InManager("delay_meter", "trk_bridge/DelayMeter") {}
};

TEST_F(DelayMeterInManager, ReportsUntilItIsUnloaded) {
  ASSERT_TRUE(load());
  EXPECT_TRUE(diagnostics.reports(status_name(), 1, "nothing on " + name_space + "/params"));
  ASSERT_TRUE(unload());
}

TEST_F(TrkToRosInManager, PublishesUntilItIsUnloadedAndCanBeLoadedAgain) {
  // Loading it again needs the port that unloading has to free.
  const ReservedPort reserved;
  set("source", reserved.url());
  // A worker thread of the manager is often in a callback when the nodelet is unloaded.
  set("diagnostic_period", 0.001);
  const Tracker tracker(reserved.number());
  std::uint64_t counter = 0;
  for (int round = 1; round <= 20; ++round) {
    TransformRecorder transforms("/tf", camera);
    ASSERT_TRUE(load()) << "round " << round;
    EXPECT_TRUE(eventually([&] {
      tracker.send(test::params(++counter));
      return !transforms.transforms.empty();
    }));
    EXPECT_TRUE(diagnostics.becomes(status_name(), "received", std::to_string(counter)));
    counter = 0;
    ASSERT_TRUE(unload()) << "unloading joins its reader";
  }
}

TEST_F(TrkToRosInManager, LoadingFailsWhenItCannotStart) {
  set("sorce", any_udp_port);
  EXPECT_FALSE(load());
}

TEST_F(RosToTrkInManager, SendsUntilItIsUnloaded) {
  const PlainSocket receiver;
  set("sinks", std::vector<std::string>{"udp://127.0.0.1:" + std::to_string(receiver.port())});
  auto publisher = ::ros::NodeHandle().advertise<trk_bridge::CameraParams>(name_space + "/params", 10);
  trk_bridge::CameraParams message;
  ros1::to_msg(test::params(7), message);
  ASSERT_TRUE(load());
  std::optional<std::string> sent;
  ASSERT_TRUE(eventually([&] {
    publisher.publish(message);
    sent = receiver.receive(std::chrono::milliseconds(10));
    return sent.has_value();
  }));
  EXPECT_EQ(*sent, datagram(test::params(7)));
  ASSERT_TRUE(unload());
}

}  // namespace trk_bridge::test::launched_test
