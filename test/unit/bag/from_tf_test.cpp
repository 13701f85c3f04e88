// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Takes from recordings of tf and camera_info.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>

#include "fixture.h"
#include "same_camera.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::bag::from_tf_test {

using testing::HasSubstr;

/// A crane: the column turns, the head is on a fixed arm, the camera looks in the head's direction.
class FromTf : public BagTest {
 protected:
  static tf2_msgs::TFMessage pan_at(double stamp, double pan_degrees) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform(stamp, "studio", "column", Eigen::Vector3d::Zero(), pan_degrees));
    return message;
  }
  void put_tf(double stamp, double pan_degrees) { bag.put("/tf", stamp, pan_at(stamp, pan_degrees)); }
  static tf2_msgs::TFMessage arm() {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform(99, "column", "head", {0, 2, 1.5}, 0));
    message.transforms.push_back(transform(99, "head", "lens_optical", Eigen::Vector3d::Zero(), 0));
    message.transforms.back().transform = ros1::to_transform(ros1::camera_T_optical());
    return message;
  }
  void put_arm() { bag.put("/tf_static", 99, arm()); }
  void put_info(double stamp, const std::string& model = "plumb_bob") {
    auto info = info_at(stamp);
    info.distortion_model = model;
    bag.put("/cam/camera_info", stamp, info);
  }
  static sensor_msgs::CameraInfo info_at(double stamp) {
    sensor_msgs::CameraInfo info;
    info.header.stamp = ::ros::Time(stamp);
    info.header.frame_id = "lens_optical";
    info.width = 1920;
    info.height = 1080;
    // 1920 pixels on 9.59 mm, 1080 on 5.39 mm.
    const double mx = 1920 / 9.59;
    const double my = 1080 / 5.39;
    info.K = {mx * 8, 0, 959.5, 0, my * 8, 539.5, 0, 0, 1};
    info.distortion_model = "plumb_bob";
    info.D = {0, 0, 0, 0, 0};
    return info;
  }
  static BagToTakeOptions with_chip() {
    BagToTakeOptions options;
    options.chip_width = 9.59;
    options.chip_height = 5.39;
    return options;
  }

  SomeBag bag{directory / "some.bag"};

 private:
  static geometry_msgs::TransformStamped transform(double stamp, const std::string& parent, const std::string& child,
                                                   const Eigen::Vector3d& at, double pan_degrees) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = camera::rotation_of({pan_degrees, 0, 0});
    pose.translation() = at;
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ::ros::Time(stamp);
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    transform.transform = ros1::to_transform(pose);
    return transform;
  }
};

TEST_F(FromTf, PosesAreComposedAndInterpolatedAtTheStampsOfCameraInfo) {
  put_arm();
  put_tf(100.0, 0);
  put_tf(100.2, 20);
  put_info(100.04);
  put_info(100.06);
  const auto take = to_take(bag.closed(), with_chip());
  ASSERT_EQ(take.params.size(), 2u);
  EXPECT_EQ(to_string(take.time_code), "00:01:40:01:1");
  for (int i = 0; i < 2; ++i) {
    const auto& e = take.params[static_cast<std::size_t>(i)].euler;
    const double pan = 4 + 2 * i;
    EXPECT_NEAR(e.pan, pan, 1e-6);
    EXPECT_NEAR(e.x, -2 * std::sin(pan * M_PI / 180), 1e-9);
    EXPECT_NEAR(e.y, 2 * std::cos(pan * M_PI / 180), 1e-9);
    EXPECT_NEAR(e.z, 1.5, 1e-9);
    EXPECT_NEAR(e.tilt, 0, 1e-6);
    EXPECT_NEAR(take.params[static_cast<std::size_t>(i)].fov, 8, 1e-9);
    EXPECT_EQ(take.params[static_cast<std::size_t>(i)].counter, static_cast<std::uint64_t>(i + 1));
  }
  EXPECT_EQ(take.constants.image_width, 1920);
  EXPECT_EQ(take.constants.chip_width, 9.59);
}

TEST_F(FromTf, TheFrameOfTheCameraAxesCanBeSet) {
  put_arm();
  put_tf(100.0, 30);
  put_tf(100.2, 30);
  put_info(100.1);
  auto options = with_chip();
  options.camera_frame = "head";
  const auto path = bag.closed();
  EXPECT_NEAR(to_take(path, options).params.at(0).euler.pan, 30, 1e-9);
  options.camera_frame = "lens_optical";
  options.camera_frame_is_optical = true;
  EXPECT_NEAR(to_take(path, options).params.at(0).euler.pan, 30, 1e-9);
  options.studio_frame = "stage";
  EXPECT_THAT(refusal(path, options), HasSubstr("no field is left"));
  EXPECT_THAT(err.str(), HasSubstr("stage"));
}

TEST_F(FromTf, TheOrderOfRecordingDoesNotMatter) {
  // 40 s, longer than the buffer of tf; transforms are late by up to 15 s.
  std::mt19937 random(1998);
  std::vector<std::string> takes;
  for (const bool shuffled : {false, true}) {
    SomeBag messages(directory / (shuffled ? "shuffled.bag" : "sorted.bag"));
    const auto recorded = [&](double stamp) {
      return shuffled ? stamp + static_cast<double>(random() % 15'000) / 1000 : stamp;
    };
    messages.put("/tf_static", shuffled ? 200 : 99, arm());
    for (int i = 0; i < 2000; ++i) {
      const double stamp = 100 + i / 50.0;
      auto tf = pan_at(stamp - 0.005, 30 * std::sin(i / 100.0));
      // The same for a stamp that occurs twice.
      if (i % 10 == 0) tf.transforms.push_back(tf.transforms.front());
      messages.put("/tf", recorded(stamp), tf);
      messages.put("/cam/camera_info", recorded(stamp), info_at(stamp));
    }
    takes.push_back(test::read_text((to_take(messages.closed(), with_chip()), directory / "back.trk")));
  }
  EXPECT_EQ(std::count(takes[0].begin(), takes[0].end(), '\n'), 3 + 2 + 1999) << "the last one has no pose after it";
  EXPECT_TRUE(takes[0] == takes[1]);
}

TEST_F(FromTf, FieldsWithoutTransformsAroundThemAreOmitted) {
  put_arm();
  put_info(99.5);
  put_tf(100.0, 0);
  put_tf(100.2, 20);
  put_info(100.1);
  put_info(100.3);
  EXPECT_EQ(to_take(bag.closed(), with_chip()).params.size(), 1u);
  EXPECT_THAT(err.str(), HasSubstr("omitted: 2 fields, the first at 99.500000000: no transforms around its time"));
}

TEST_F(FromTf, WithoutConstantsTheChipSizeMustBeSet) {
  put_arm();
  put_tf(100.0, 0);
  put_tf(100.2, 0);
  put_info(100.1);
  EXPECT_THAT(refusal(bag.closed()), HasSubstr("set --chip-width MM and --chip-height MM"));
}

TEST_F(FromTf, InvalidSizesAreNamed) {
  put_arm();
  put_tf(100.0, 0);
  put_tf(100.2, 0);
  auto info = info_at(100.1);
  info.width = 0;
  bag.put("/cam/camera_info", 100.1, info);
  EXPECT_THAT(refusal(bag.closed(), with_chip()),
              HasSubstr("some.bag: a chip of 9.59 x 5.39 mm (--chip-width, --chip-height) and an image of 0 x 1080 "
                        "pixels (camera_info) describe no picture"));

  SomeBag other(directory / "other.bag");
  other.put("/cam/camera_info", 100.1, info_at(100.1));
  other.put("/tf", 100.1, tf2_msgs::TFMessage());
  auto options = with_chip();
  options.chip_height = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(other.closed(), options), HasSubstr("a chip of 9.59 x inf mm"));
}

TEST_F(FromTf, AModelThatTrkCannotExpressIsNamed) {
  put_arm();
  put_tf(100.0, 0);
  put_tf(100.2, 0);
  put_info(100.1, "equidistant");
  EXPECT_THAT(refusal(bag.closed(), with_chip()), HasSubstr("no field is left"));
  EXPECT_THAT(err.str(),
              HasSubstr("distortion_model 'equidistant' and 5 coefficients: distortion_model must be plumb_bob or"));
}

TEST_F(FromTf, EightCoefficientsOfPlumbBobAreRefused) {
  put_arm();
  put_tf(100.0, 0);
  put_tf(100.2, 0);
  auto info = info_at(100.1);
  info.D.resize(8);
  bag.put("/cam/camera_info", 100.1, info);
  EXPECT_THAT(refusal(bag.closed(), with_chip()), HasSubstr("no field is left"));
  EXPECT_THAT(err.str(),
              HasSubstr("'plumb_bob' and 8 coefficients: D must have 0, 4 or 5 coefficients with plumb_bob"));
}

TEST_F(FromTf, BinningAndRegionOfInterestDoNotChangeTheLens) {
  put_arm();
  put_tf(100.0, 0);
  put_tf(100.2, 0);
  put_info(100.04);
  auto info = info_at(100.06);
  info.binning_x = info.binning_y = 2;
  info.roi.x_offset = 100;
  info.roi.width = 400;
  info.roi.height = 300;
  bag.put("/cam/camera_info", 100.06, info);
  const auto take = to_take(bag.closed(), with_chip());
  ASSERT_EQ(take.params.size(), 2u);
  EXPECT_EQ(take.params[1].fov, take.params[0].fov);
  EXPECT_EQ(take.params[1].center_x, take.params[0].center_x);
}

TEST_F(FromTf, WithoutTfThePoseIsUnknown) {
  put_info(100);
  EXPECT_THAT(refusal(bag.closed(), with_chip()), HasSubstr("neither /tf nor /tf_static"));
}

TEST_F(FromTf, ALongRecordingIsConvertedCompletely) {
  put_arm();
  for (int i = 0; i <= 3000; ++i) put_tf(1000 + 0.02 * i, 0.1 * i);
  for (int i = 0; i < 3000; ++i) put_info(1000.01 + 0.02 * i);
  const auto take = to_take(bag.closed(), with_chip());
  ASSERT_EQ(take.params.size(), 3000u);
  for (std::size_t i = 0; i < take.params.size(); ++i) {
    ASSERT_LT(test::degrees_apart(take.params[i].euler.pan, 0.1 * static_cast<double>(i) + 0.05), 1e-5) << i;
  }
}

/// The takes of existing programs, through tf and camera_info.
class TakeThroughTf : public BagTest, public testing::WithParamInterface<const char*> {};

TEST_P(TakeThroughTf, IsTheSameCamera) {
  const auto path = test::data_path(GetParam());
  const auto sent = file::read_take(path);
  const auto bag_path = to_bag(path);
  BagToTakeOptions options;
  options.input = Input::tf;
  const auto back = to_take(bag_path, options);
  EXPECT_EQ(back.time_code, sent.time_code);
  ASSERT_EQ(back.params.size(), sent.params.size());
  for (std::size_t i = 0; i < sent.params.size(); ++i) {
    const auto a = camera::decode(sent.params[i], &sent.constants).value();
    const auto b = camera::decode(back.params[i], &back.constants).value();
    ASSERT_LT((a.pose.translation() - b.pose.translation()).norm(), 1e-6) << i;
    ASSERT_LT(Eigen::AngleAxisd(a.pose.linear().transpose() * b.pose.linear()).angle(), 1e-6) << i;
    const auto k = camera::camera_matrix(a.lens, sent.constants);
    const auto l = camera::camera_matrix(b.lens, back.constants);
    for (std::size_t n = 0; n < 9; ++n) ASSERT_NEAR(k[n], l[n], 0.02) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(FieldTakes, TakeThroughTf,
                         testing::Values("field/takes/euler.trk",
                                         "field/takes/euler-ignore_blank-keep_aspect-field_of_view-vertical.trk",
                                         "field/takes/matrix-studio_to_camera-camera_y_up-studio_y_up.trk"),
                         [](const auto& test) { return "Take" + std::to_string(test.index); });

}  // namespace trk_bridge::bag::from_tf_test
