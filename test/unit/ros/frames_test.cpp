// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/ros/frames.h"

#include <cmath>

#include <gmock/gmock.h>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::ros1::frames_test {

/// A vector turned by a quaternion, written out: independent of Eigen's rotation code.
std::array<double, 3> turned(const geometry_msgs::Quaternion& q, std::array<double, 3> v) {
  const double cx = q.y * v[2] - q.z * v[1] + q.w * v[0];
  const double cy = q.z * v[0] - q.x * v[2] + q.w * v[1];
  const double cz = q.x * v[1] - q.y * v[0] + q.w * v[2];
  return {v[0] + 2 * (q.y * cz - q.z * cy), v[1] + 2 * (q.z * cx - q.x * cz), v[2] + 2 * (q.x * cy - q.y * cx)};
}

TEST(Frames, OpticalFrameLooksAlongTheCamerasYAxis) {
  const auto q = to_transform(camera_T_optical()).rotation;
  // Rotation by -90 degrees about x.
  EXPECT_NEAR(q.w, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(q.x, -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(q.y, 0, 1e-15);
  EXPECT_NEAR(q.z, 0, 1e-15);
  const auto forward = turned(q, {0, 0, 1});
  EXPECT_NEAR(forward[1], 1, 1e-15);
  const auto down = turned(q, {0, 1, 0});
  EXPECT_NEAR(down[2], -1, 1e-15);
}

TEST(Frames, PanTurnsTheViewToTheLeftTiltUp) {
  wire::CameraParams params;
  params.format = wire::euler;
  params.euler = {1, 2, 3, 90, 0, 0};
  params.fov = 10;
  auto transform = to_transform(camera::decode_pose(params).value());
  EXPECT_EQ(transform.translation.x, 1);
  EXPECT_EQ(transform.translation.y, 2);
  EXPECT_EQ(transform.translation.z, 3);
  // Looking into the studio (+y), a quarter turn to the left looks at -x.
  EXPECT_NEAR(turned(transform.rotation, {0, 1, 0})[0], -1, 1e-15);

  params.euler = {0, 0, 0, 0, 90, 0};
  transform = to_transform(camera::decode_pose(params).value());
  EXPECT_NEAR(turned(transform.rotation, {0, 1, 0})[2], 1, 1e-15);

  // Roll clockwise, seen from behind: the right side goes down.
  params.euler = {0, 0, 0, 0, 0, 90};
  transform = to_transform(camera::decode_pose(params).value());
  EXPECT_NEAR(turned(transform.rotation, {1, 0, 0})[2], -1, 1e-15);
}

TEST(Frames, EveryCaseArrivesAsItsStudioTCamera) {
  for (const auto& line : test::read_jsonl("camera_cases.jsonl")) {
    const auto pose = camera::decode_pose(test::case_params_of(line["params"]));
    ASSERT_TRUE(pose);
    const auto transform = to_transform(*pose);
    const auto& rows = line["expect"]["studio_T_camera_rows"];
    const double translation[] = {transform.translation.x, transform.translation.y, transform.translation.z};
    for (unsigned axis = 0; axis < 3; ++axis) {
      std::array<double, 3> unit{};
      unit[axis] = 1;
      const auto column = turned(transform.rotation, unit);
      for (unsigned row = 0; row < 3; ++row) EXPECT_NEAR(column[row], rows[4 * row + axis].GetDouble(), 1e-12);
    }
    for (unsigned row = 0; row < 3; ++row) {
      const double expected = rows[4 * row + 3].GetDouble();
      EXPECT_NEAR(translation[row], expected, 1e-12 * (1 + std::abs(expected)));
    }
    EXPECT_GE(transform.rotation.w, 0);
    EXPECT_TRUE(to_isometry(transform).isApprox(*pose, 1e-12));
  }
}

TEST(Frames, OpticalTransformIsTheStaticOneOfTf) {
  const auto transform = optical_transform({"studio", "crane1", "crane1_optical"}, ::ros::Time(12, 34));
  EXPECT_EQ(transform.header.stamp, ::ros::Time(12, 34));
  EXPECT_EQ(transform.header.frame_id, "crane1");
  EXPECT_EQ(transform.child_frame_id, "crane1_optical");
  // -90 degrees about x.
  EXPECT_NEAR(transform.transform.rotation.x, -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(transform.transform.rotation.w, std::sqrt(0.5), 1e-15);
}

}  // namespace trk_bridge::ros1::frames_test
