// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The worked cases through both nodes: trk over UDP, topics and tf, trk over UDP.
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "../unit/camera/worked_cases.h"
#include "fixture.h"
#include "nodes/ros_to_trk.h"
#include "receiver.h"
#include "same_camera.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::test::round_trip_test {

/// The input of ros_to_trk is set by each test.
class RoundTripOfNodes : public TrkToRosTest {
 protected:
  void SetUp() override {
    set("source", any_udp_port);
    ASSERT_TRUE(starts());
    tracker.emplace(port());
  }

  /// Sends a case until what is received back is `same`: constants and parameters use separate connections, so that the
  /// first parameters after a change may be combined with the previous constants.
  template <typename Same>
  void expect_back(const WorkedCase& one, Receiver& receiver, Same same) {
    const auto end = std::chrono::steady_clock::now() + deadline;
    ::testing::AssertionResult result = ::testing::AssertionFailure() << "nothing was received back";
    while (!result && std::chrono::steady_clock::now() < end) {
      auto record = one.params;
      record.counter = ++counter;
      const auto sets = receiver.params.size();
      tracker->send(one.constants);
      tracker->send(record);
      const auto arrived = [&] {
        receiver.take();
        return receiver.params.size() > sets;
      };
      if (!eventually(arrived, std::chrono::milliseconds(100)) || receiver.constants.empty()) continue;
      const auto back = camera::decode(receiver.params.back(), &receiver.constants.back());
      if (back) result = same(*back);
    }
    EXPECT_TRUE(result) << wire::format_to_words(one.mask);
  }

  std::optional<Tracker> tracker;
  std::uint64_t counter = 0;
};

class ThroughParams : public RoundTripOfNodes, public ::testing::WithParamInterface<const char*> {};

TEST_P(ThroughParams, EveryCaseIsTheSameCamera) {
  Receiver receiver;
  const std::string name = name_space + "/ros_to_trk";
  ::ros::param::set(name + "/sinks", std::vector<std::string>{receiver.url() + "?binary=1"});
  ::ros::param::set(name + "/format", GetParam());
  const nodes::RosToTrk outgoing(::ros::NodeHandle(name_space), ::ros::NodeHandle(name), name);
  for (const auto& one : worked_cases()) {
    expect_back(one, receiver, [&one](const camera::Camera& back) { return same_to_the_digits(back, one.camera); });
    if (HasFailure()) return;
  }
  EXPECT_EQ(receiver.params.back().counter, counter) << "passed on";
}

INSTANTIATE_TEST_SUITE_P(As, ThroughParams,
                         ::testing::Values("euler",
                                           "studio_to_camera camera_y_up studio_y_up field_of_view diagonal "
                                           "ignore_blank keep_aspect shift_in_pixels"),
                         [](const auto& test) { return test.index == 0 ? "Euler" : "Everything"; });

/// ros_to_trk is created again for every chip.
class ThroughTf : public RoundTripOfNodes {
 protected:
  using Picture = std::tuple<double, double, int, int, int, int>;

  static Picture picture_of(const wire::CameraConstants& c) {
    return {c.chip_width, c.chip_height, c.blank_left, c.blank_right, c.blank_top, c.blank_bottom};
  }

  std::unique_ptr<nodes::RosToTrk> ros_to_trk(const std::string& name_space_of_chip, const wire::CameraConstants& c,
                                              const Receiver& receiver) {
    const std::string name = name_space_of_chip + "/ros_to_trk";
    const auto set_one = [&name](const char* key, const auto& value) { ::ros::param::set(name + "/" + key, value); };
    set_one("sinks", std::vector<std::string>{receiver.url()});
    set_one("input", "tf");
    set_one("rate", 500.0);
    set_one("preset", "orad");
    set_one("camera_frame", camera + "_optical");
    set_one("camera_frame_is_optical", true);
    set_one("chip_width", c.chip_width);
    set_one("chip_height", c.chip_height);
    set_one("blank_left", c.blank_left);
    set_one("blank_right", c.blank_right);
    set_one("blank_top", c.blank_top);
    set_one("blank_bottom", c.blank_bottom);
    const ::ros::M_string remapped{{"camera_info", name_space + "/camera_info"}};
    return std::make_unique<nodes::RosToTrk>(::ros::NodeHandle(name_space_of_chip, remapped), ::ros::NodeHandle(name),
                                             name);
  }
};

TEST_F(ThroughTf, EveryCaseIsTheSameCamera) {
  std::map<Picture, std::vector<WorkedCase>> by_picture;
  for (const auto& one : worked_cases()) by_picture[picture_of(one.constants)].push_back(one);
  int made = 0;
  std::size_t cases = 0;
  for (const auto& [picture, ones] : by_picture) {
    Receiver receiver;
    const auto outgoing = ros_to_trk("/chip" + std::to_string(++made), ones.front().constants, receiver);
    for (const auto& one : ones) {
      expect_back(one, receiver,
                  [&one](const camera::Camera& back) { return same_to_the_eye(back, one.camera, one.constants); });
      if (HasFailure()) return;
    }
    for (std::size_t i = 0; i < receiver.params.size(); ++i) EXPECT_EQ(receiver.params[i].counter, i + 1);
    cases += ones.size();
  }
  EXPECT_EQ(cases, 256u);
}

}  // namespace trk_bridge::test::round_trip_test
