// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "demo/crane_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <urdf/model.h>
#include <Eigen/Geometry>

#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::demo::crane_motion_test {

constexpr double field = 0.02;  // s
const int fields = static_cast<int>(shot_duration / field);

Eigen::Isometry3d isometry(const urdf::Pose& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() << pose.position.x, pose.position.y, pose.position.z;
  result.linear() =
      Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z).toRotationMatrix();
  return result;
}

/// The crane as its URDF describes it, moved by the joints of the shot.
class Crane {
 public:
  Crane() {
    if (!model_.initFile(CRANE_URDF)) throw std::runtime_error(CRANE_URDF);
  }

  const urdf::Joint& joint(const std::string& name) const { return *model_.getJoint(name); }

  Eigen::Isometry3d pose(const std::string& link, const Moment& moment) const {
    const auto here = model_.getLink(link);
    const auto parent_joint = here->parent_joint;
    if (!parent_joint) return Eigen::Isometry3d::Identity();
    const Eigen::Isometry3d parent = pose(parent_joint->parent_link_name, moment);
    return parent * isometry(parent_joint->parent_to_joint_origin_transform) * motion(*parent_joint, moment);
  }

 private:
  static Eigen::Isometry3d motion(const urdf::Joint& joint, const Moment& moment) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    if (joint.type == urdf::Joint::FIXED) return result;
    const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
    const double position = joint.mimic
                                ? joint.mimic->multiplier * of(joint.mimic->joint_name, moment) + joint.mimic->offset
                                : of(joint.name, moment);
    if (joint.type == urdf::Joint::PRISMATIC) {
      result.translation() = position * axis;
    } else {
      result.linear() = Eigen::AngleAxisd(position, axis).toRotationMatrix();
    }
    return result;
  }

  static double of(const std::string& joint, const Moment& moment) {
    const auto found = std::find(joint_names.begin(), joint_names.end(), joint);
    if (found == joint_names.end()) throw std::runtime_error("the shot does not move " + joint);
    return moment.joints[static_cast<std::size_t>(found - joint_names.begin())];
  }

  urdf::Model model_;
};

TEST(CraneMotion, TheCameraOfTheUrdfHasTheTargetInTheMiddleAndInFocus) {
  const Crane crane;
  for (int i = 0; i < fields; ++i) {
    const Moment moment = moment_at(i * field);
    const Eigen::Vector3d seen = crane.pose("camera", moment).inverse() * moment.target;
    ASSERT_NEAR(seen.x(), 0, 1e-9) << "at field " << i;
    ASSERT_NEAR(seen.z(), 0, 1e-9) << "at field " << i;
    ASSERT_NEAR(seen.y(), moment.lens.focdist, 1e-9) << "at field " << i;
    ASSERT_GT(moment.lens.focdist, 1.0) << "clear of the lens, at field " << i;
  }
}

TEST(CraneMotion, TheHeadStaysLevelExceptForItsRoll) {
  const Crane crane;
  double most = 0;
  for (int i = 0; i < fields; ++i) {
    const Moment moment = moment_at(i * field);
    EXPECT_NEAR(crane.pose("head_mount", moment).linear()(2, 2), 1, 1e-12);
    EXPECT_NEAR(crane.pose("tilt_head", moment).linear()(2, 0), 0, 1e-12) << "its right is level";
    most = std::max(most, std::abs(moment.joints[5]));
  }
  EXPECT_NEAR(most, 8 * M_PI / 180, 1e-6);
}

TEST(CraneMotion, TheOpticalFrameIsThatOfRep103) {
  const Crane crane;
  const Moment moment = moment_at(7);
  const Eigen::Matrix3d turn = (crane.pose("camera", moment).inverse() * crane.pose("camera_optical", moment)).linear();
  EXPECT_LT((turn.col(0) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15) << "x right";
  EXPECT_LT((turn.col(1) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-15) << "y down";
  EXPECT_LT((turn.col(2) - Eigen::Vector3d(0, 1, 0)).norm(), 1e-15) << "z forward";
}

TEST(CraneMotion, JointsKeepTheLimitsOfTheUrdf) {
  const Crane crane;
  for (std::size_t j = 0; j < joint_names.size(); ++j) {
    const urdf::Joint& joint = crane.joint(joint_names[j]);
    double least = 1e9, most = -1e9, fastest = 0;
    for (int i = 0; i < fields; ++i) {
      const double now = moment_at(i * field).joints[j];
      least = std::min(least, now);
      most = std::max(most, now);
      fastest = std::max(fastest, std::abs(moment_at((i + 1) * field).joints[j] - now) / field);
    }
    ASSERT_TRUE(joint.limits);
    EXPECT_LE(fastest, joint.limits->velocity) << joint.name;
    EXPECT_GT(fastest, 0.02) << joint.name << " is used in the shot";
    if (joint.type == urdf::Joint::CONTINUOUS) continue;
    EXPECT_GE(least, joint.limits->lower) << joint.name;
    EXPECT_LE(most, joint.limits->upper) << joint.name;
  }
}

TEST(CraneMotion, TheLevellingJointCanFollowTheArm) {
  const Crane crane;
  const auto &arm = *crane.joint("arm_elevation").limits, &level = *crane.joint("head_level").limits;
  EXPECT_DOUBLE_EQ(level.lower, -arm.upper);
  EXPECT_DOUBLE_EQ(level.upper, -arm.lower);
  EXPECT_DOUBLE_EQ(level.velocity, arm.velocity);
}

TEST(CraneMotion, EverythingIsSmoothOverMarksAndTheRepeat) {
  const Crane crane;
  const auto second = [](auto a, auto b, auto c) { return (a - 2 * b + c) / (field * field); };
  // A jump in position, direction or lens would be an acceleration that is too high for a crane.
  for (int i = 0; i <= fields; ++i) {
    const Moment before = moment_at((i - 1) * field), now = moment_at(i * field), after = moment_at((i + 1) * field);
    const Eigen::Isometry3d a = crane.pose("camera", before), b = crane.pose("camera", now),
                            c = crane.pose("camera", after);
    const Eigen::Vector3d acceleration = second(a.translation(), b.translation(), c.translation());
    ASSERT_LT(acceleration.norm(), 1.5) << "m/s^2 at field " << i;
    const Eigen::Matrix3d turn = second(a.linear(), b.linear(), c.linear());
    ASSERT_LT(turn.norm(), 1.0) << "rad/s^2 at field " << i;
    const auto& [f, g, h] = std::tie(before.lens, now.lens, after.lens);
    ASSERT_LT(std::abs(second(f.image_distance, g.image_distance, h.image_distance)), 20) << "at field " << i;
    ASSERT_LT(std::abs(second(f.k1, g.k1, h.k1)), 1e-3) << "at field " << i;
    ASSERT_LT(std::abs(second(f.focdist, g.focdist, h.focdist)), 1.5) << "at field " << i;
  }
}

TEST(CraneMotion, TheShotRepeatsFromRest) {
  const Crane crane;
  const Moment first = moment_at(0);
  const Moment again = moment_at(3 * shot_duration);
  for (std::size_t j = 0; j < joint_names.size(); ++j) EXPECT_DOUBLE_EQ(first.joints[j], again.joints[j]);
  EXPECT_DOUBLE_EQ(first.lens.image_distance, again.lens.image_distance);
  const Eigen::Vector3d start = crane.pose("camera", first).translation();
  EXPECT_LT((crane.pose("camera", moment_at(field)).translation() - start).norm(), 1e-4) << "m";
  EXPECT_GT((crane.pose("camera", moment_at(5)).translation() - start).norm(), 1) << "m";
}

TEST(CraneMotion, TheCameraClearsTheFloor) {
  const Crane crane;
  double highest = 0;
  for (int i = 0; i < fields; ++i) {
    const double height = crane.pose("camera", moment_at(i * field)).translation().z();
    highest = std::max(highest, height);
    ASSERT_GT(height, 0.4) << "at field " << i;
  }
  EXPECT_GT(highest, 3.5);
}

TEST(CraneMotion, TheLensGoesFromBarrelToCushionAndNeverFoldsThePicture) {
  const wire::CameraConstants constants = camera_constants();
  ASSERT_TRUE(camera::check(constants));
  camera::Calibrator calibrator;
  double least = 1e9, most = 0, least_k1 = 1, most_k1 = -1;
  for (int i = 0; i < fields; ++i) {
    const camera::Lens lens = moment_at(i * field).lens;
    least = std::min(least, lens.image_distance);
    most = std::max(most, lens.image_distance);
    least_k1 = std::min(least_k1, lens.k1);
    most_k1 = std::max(most_k1, lens.k1);
    const auto calibration = calibrator.calibrate(lens, constants);
    ASSERT_TRUE(calibration) << camera::describe(calibration.error()) << " at field " << i;
    ASSERT_LT(calibration->distortion.residual, 0.01) << "pixels at field " << i;
  }
  EXPECT_NEAR(least, 9, 1e-9);
  EXPECT_NEAR(most, 46, 1e-9);
  EXPECT_GT(most_k1, 0) << "barrel when wide";
  EXPECT_LT(least_k1, 0) << "cushion when long";
}

}  // namespace trk_bridge::demo::crane_motion_test
