// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Several cameras in one node, and sources other than UDP.
#include <trk_bridge/CameraParams.h>

#include <algorithm>
#include <map>
#include <string>

#include "fixture.h"
#include "free_slot.h"
#include "node_process.h"
#include "program.h"
#include "temporary_directory.h"
#include "trk_bridge/endpoints/endpoints.h"

namespace trk_bridge::test::several_cameras_test {

class SeveralCameras : public TrkToRosTest {};

TEST_F(SeveralCameras, ThreeOfTheExampleConfigurationOnOnePortAndInSharedMemory) {
  Program loading({"/usr/bin/env", "rosparam", "load", THREE_CAMERAS, "/three_cameras"});
  const std::string output = loading.rest_of_err();
  ASSERT_EQ(loading.wait(), 0) << output;
  XmlRpc::XmlRpcValue tree;
  ASSERT_TRUE(::ros::param::get("/three_cameras", tree));
  ASSERT_EQ(ros1::read_trk_to_ros_parameters(tree, "unused").cameras.size(), 3u) << "the file itself is valid";
  const FreeSlot free_slot;
  const std::string slot = "shm:" + std::to_string(free_slot.number());
  tree["source"] = any_udp_port;
  tree["cameras"]["pedestal"]["source"] = slot;
  tree["diagnostic_period"] = 0.1;
  ::ros::param::set(node_name, tree);

  Recorder<trk_bridge::CameraParams> one(name_space + "/crane1/params"), two(name_space + "/crane2/params"),
      three(name_space + "/pedestal/params");
  TransformRecorder frame_one("/tf", "crane1"), frame_two("/tf", "crane2"), frame_three("/tf", "pedestal_head");
  TransformRecorder optical("/tf_static", "pedestal_optical");
  ASSERT_TRUE(starts("pedestal"));
  ASSERT_TRUE(reports_on("crane1"));

  Tracker tracker(port("crane1"));
  auto sink = endpoints::open_sink(slot);
  for (std::uint64_t counter = 1; counter <= 3; ++counter) {
    tracker.send(test::params(counter, 1));
    tracker.send(test::params(counter + 100, 2));
    tracker.send(test::params(counter, 9));
  }
  EXPECT_TRUE(eventually([&] { return one.messages.size() == 3 && two.messages.size() == 3; }));
  EXPECT_EQ(two.messages.back().counter, 103u);
  // Records that were written before the reader attached are not new to it.
  std::uint64_t counter = 0;
  EXPECT_TRUE(eventually([&] {
    EXPECT_TRUE(sink->write(test::params(++counter)));
    return !three.messages.empty() && !frame_three.transforms.empty();
  }));
  EXPECT_TRUE(eventually([&] { return frame_one.transforms.size() == 3 && frame_two.transforms.size() == 3; }));
  EXPECT_TRUE(eventually([&] { return !optical.transforms.empty(); }));
  EXPECT_EQ(optical.transforms.front().header.frame_id, "pedestal_head");
  EXPECT_TRUE(diagnostics.becomes(status_name("crane1"), "received", "3"));
  EXPECT_TRUE(diagnostics.becomes(status_name("crane2"), "unknown ids", "3"));
  EXPECT_TRUE(diagnostics.becomes(status_name("pedestal"), "constants known", "from the parameter"));
  EXPECT_TRUE(sink->close());
}

TEST_F(SeveralCameras, OfTwoHundredAndFiftySixSimultaneousCamerasNoneLosesATransform) {
  constexpr int count = 256, bursts = 10;
  const auto frame = [](int i) { return "many" + std::to_string(i); };
  XmlRpc::XmlRpcValue tree;
  tree["source"] = any_udp_port;
  tree["publish_camera_info"] = false;
  tree["diagnostic_period"] = 0.5;
  for (int i = 1; i <= count; ++i) {
    tree["cameras"][frame(i)]["id"] = i;
    tree["cameras"][frame(i)]["camera_frame"] = frame(i);
  }
  ::ros::param::set(node_name, tree);
  Recorder<tf2_msgs::TFMessage> tf("/tf");
  ASSERT_TRUE(starts(frame(1)));
  ASSERT_TRUE(reports_on(frame(count)));
  const Tracker tracker(port(frame(1)));
  const auto transforms = [&] {
    std::map<std::string, int> of_frame;
    for (const auto& message : tf.messages) {
      for (const auto& transform : message.transforms) ++of_frame[transform.child_frame_id];
    }
    return of_frame;
  };
  for (int burst = 1; burst <= bursts; ++burst) {
    for (int i = 1; i <= count; ++i) {
      tracker.send(test::params(static_cast<std::uint64_t>(burst), static_cast<std::uint32_t>(i)));
    }
    ASSERT_TRUE(eventually([&] {
      const auto of_frame = transforms();
      return of_frame.size() == count &&
             std::all_of(of_frame.begin(), of_frame.end(), [burst](const auto& one) { return one.second == burst; });
    })) << "burst "
        << burst;
  }
  EXPECT_EQ(diagnostics.value(status_name(frame(1)), "kernel drops"), "0");
}

class AtTheEndOfATake : public NodeProcessTest {
 protected:
  AtTheEndOfATake() : NodeProcessTest(TRK_TO_ROS) {}
  const TemporaryDirectory folder;
};

TEST_F(AtTheEndOfATake, TheNodeRunsUntilItIsInterrupted) {
  const std::string path = folder / "take.trk";
  {
    auto sink = endpoints::open_sink("file:" + path);
    ASSERT_TRUE(sink->write(test::constants()));
    for (std::uint64_t counter = 1; counter <= 50; ++counter) ASSERT_TRUE(sink->write(test::params(counter)));
    ASSERT_TRUE(sink->close());
  }
  set("source", "file:" + path + "?time=now");
  Recorder<trk_bridge::CameraParams> params(name_space + "/params");
  ASSERT_TRUE(starts());
  EXPECT_TRUE(diagnostics.reports(status_name(), diagnostic_msgs::DiagnosticStatus::OK, "ended"));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "received", "50"));
  ASSERT_TRUE(eventually([&] { return !params.messages.empty() && params.messages.back().counter == 50; }));
  interrupted();
}

class FaultyTake : public TrkToRosTest {
 protected:
  void SetUp() override { set("source", "file:" + path); }

  const TemporaryDirectory folder;
  const std::string path = folder / "faulty.trk";
};

TEST_F(FaultyTake, IsRefusedWithTheLineOfItsHead) {
  write_text(path, "DMC01\n00:00:00:00:1\n1920 1080 0 0 0 0 9.59 5.39 9.59\n");
  EXPECT_THAT(refusal(), ::testing::HasSubstr("faulty.trk:3"));
}

TEST_F(FaultyTake, EndsWithAnErrorAtAFaultyField) {
  write_text(path, "DMC01\n00:00:00:00:1\n1920 1080 0 0 0 0 9.59 5.39 9.59 5.39\n1 1 2 three\n");
  ASSERT_TRUE(starts());
  EXPECT_TRUE(diagnostics.reports(status_name(), diagnostic_msgs::DiagnosticStatus::ERROR, "faulty.trk:4"));
}

}  // namespace trk_bridge::test::several_cameras_test
