// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The worked cases, sent over UDP in their formats, as received in ROS.
#include <cmath>

#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "fixture.h"
#include "same_camera.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::test::worked_cases_test {

class WorkedCases : public TrkToRosTest, public ::testing::WithParamInterface<wire::Encoding> {
 protected:
  void SetUp() override {
    set("source", any_udp_port);
    set("stamp", "arrival");
    set("diagnostic_period", 1.0);
    params.emplace(name_space + "/params");
    infos.emplace(name_space + "/camera_info");
    transforms.emplace("/tf", camera);
    statics.emplace("/tf_static", camera + "_optical");
    ASSERT_TRUE(starts());
    tracker.emplace(port());
  }

  void send(const wire::CameraConstants& constants, const wire::CameraParams& record) {
    wire::WireForm form;
    form.encoding = GetParam();
    form.layout.generation = wire::Generation::identified;
    const auto last = transforms->transforms.size();
    sent = ::ros::Time::now();
    tracker->send(constants, form);
    tracker->send(record, form);
    ASSERT_TRUE(eventually([&] {
      return transforms->transforms.size() > last && params->messages.size() > last && infos->messages.size() > last;
    })) << "of "
        << last << ": " << transforms->transforms.size() << " tf, " << params->messages.size() << " params, "
        << infos->messages.size() << " camera_info";
    arrived = ::ros::Time::now();
  }

  void expect_stamps(::ros::Time before) const {
    const auto stamp = transforms->transforms.back().header.stamp;
    EXPECT_EQ(params->messages.back().header.stamp, stamp);
    EXPECT_EQ(infos->messages.back().header.stamp, stamp);
    EXPECT_GT(stamp, before);
    EXPECT_GE(stamp, sent);
    EXPECT_LE(stamp, arrived);
  }

  void expect_pose(const rapidjson::Value& expect) const {
    const auto pose = ros1::to_isometry(transforms->transforms.back().transform);
    const auto& rows = expect["studio_T_camera_rows"];
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        const double wanted = rows[static_cast<unsigned>(4 * row + column)].GetDouble();
        EXPECT_NEAR(pose(row, column), wanted, 1e-9 * (1 + std::abs(wanted)));
      }
    }
  }

  void expect_params(const rapidjson::Value& expect) const {
    const auto& m = params->messages.back();
    EXPECT_EQ(m.format, std::uint32_t{wire::euler});
    EXPECT_EQ(m.header.frame_id, "studio");
    const auto& e = expect["euler"];
    const auto near = [](double value, double wanted) { EXPECT_NEAR(value, wanted, 1e-9 * (1 + std::abs(wanted))); };
    near(m.x, e["x"].GetDouble());
    near(m.y, e["y"].GetDouble());
    near(m.z, e["z"].GetDouble());
    // Pan and roll are one rotation where the camera looks straight up or down.
    if (std::abs(std::abs(e["tilt"].GetDouble()) - 90) > 1e-3) {
      EXPECT_LT(degrees_apart(m.pan, e["pan"].GetDouble()), 1e-7);
      EXPECT_LT(degrees_apart(m.roll, e["roll"].GetDouble()), 1e-7);
    }
    EXPECT_LT(degrees_apart(m.tilt, e["tilt"].GetDouble()), 1e-7);
    near(m.fov, expect["image_distance_mm"].GetDouble());
    near(m.center_x, expect["center_shift_mm"][0].GetDouble());
    near(m.center_y, expect["center_shift_mm"][1].GetDouble());
  }

  void expect_image(const rapidjson::Value& expect) const {
    const auto& info = infos->messages.back();
    EXPECT_EQ(info.header.frame_id, camera + "_optical");
    for (unsigned i = 0; i < 9; ++i) {
      const double wanted = expect["K"][i].GetDouble();
      EXPECT_NEAR(info.K[i], wanted, 1e-9 * (1 + std::abs(wanted)));
    }
    image_geometry::PinholeCameraModel model;
    model.fromCameraInfo(info);
    const auto optical_T_studio = (ros1::to_isometry(transforms->transforms.back().transform) *
                                   ros1::to_isometry(statics->transforms.front().transform))
                                      .inverse();
    for (const auto& point : expect["points"].GetArray()) {
      const auto& s = point["studio"];
      const Eigen::Vector3d p =
          optical_T_studio * Eigen::Vector3d(s[0].GetDouble(), s[1].GetDouble(), s[2].GetDouble());
      const auto pixel = model.unrectifyPoint(model.project3dToPixel({p.x(), p.y(), p.z()}));
      const auto& wanted = point["pixel_distorted"];
      EXPECT_LT(std::hypot(pixel.x - wanted[0].GetDouble(), pixel.y - wanted[1].GetDouble()), 0.02);
    }
  }

  std::optional<Recorder<trk_bridge::CameraParams>> params;
  std::optional<Recorder<sensor_msgs::CameraInfo>> infos;
  std::optional<TransformRecorder> transforms, statics;
  std::optional<Tracker> tracker;
  ::ros::Time sent, arrived;
};

TEST_P(WorkedCases, ArriveWithTheRightMeaning) {
  ASSERT_TRUE(eventually([this] { return !statics->transforms.empty(); }));
  std::uint64_t counter = 1000;
  ::ros::Time before;
  for (const auto& line : read_jsonl("camera_cases.jsonl")) {
    SCOPED_TRACE("mask " + std::to_string(line["mask"].GetUint()) + ": " +
                 wire::format_to_words(line["mask"].GetUint()));
    auto record = case_params_of(line["params"]);
    record.counter = ++counter;
    ASSERT_NO_FATAL_FAILURE(send(constants_of(line["constants"]), record));
    expect_stamps(before);
    expect_pose(line["expect"]);
    expect_params(line["expect"]);
    expect_image(line["expect"]);
    before = arrived = transforms->transforms.back().header.stamp;
    if (HasFailure()) return;
  }
  EXPECT_EQ(counter, 1256u);
}

INSTANTIATE_TEST_SUITE_P(Encoded, WorkedCases, ::testing::Values(wire::Encoding::ascii, wire::Encoding::binary),
                         [](const auto& test) { return test.param == wire::Encoding::ascii ? "Ascii" : "Binary"; });

}  // namespace trk_bridge::test::worked_cases_test
