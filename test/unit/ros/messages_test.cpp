// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/ros/messages.h"

#include <gmock/gmock.h>

#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::ros1::messages_test {

wire::CameraParams numbered(std::uint32_t format) {
  wire::CameraParams p;
  p.id = 7;
  p.format = format;
  for (std::size_t i = 0; i < 16; ++i) p.matrix[i] = static_cast<double>(100 + i);
  p.euler = {1, 2, 3, 4, 5, 6};
  p.fov = 8;
  p.center_x = 9;
  p.center_y = 10;
  p.k1 = 11;
  p.k2 = 12;
  p.focdist = 13;
  p.aperture = 14;
  p.counter = 0xFFFFFFFFFFFFFFFF;
  return p;
}

TEST(Messages, EulerParamsFieldByField) {
  trk_bridge::CameraParams m;
  m.matrix.fill(99);
  to_msg(numbered(0x80000001), m);
  EXPECT_EQ(m.id, 7u);
  EXPECT_EQ(m.format, 0x80000001u);
  EXPECT_EQ(m.counter, 0xFFFFFFFFFFFFFFFFu);
  EXPECT_EQ((std::vector<double>{m.x, m.y, m.z, m.pan, m.tilt, m.roll, m.fov, m.center_x, m.center_y, m.k1, m.k2,
                                 m.focdist, m.aperture}),
            (std::vector<double>{1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14}));
  EXPECT_THAT(m.matrix, ::testing::Each(0)) << "the format does not select it";
}

TEST(Messages, MatrixParamsAreColumnMajor) {
  trk_bridge::CameraParams m;
  to_msg(numbered(wire::camera_y_up), m);
  EXPECT_EQ(m.x, 0);
  EXPECT_EQ(m.roll, 0);
  EXPECT_EQ(m.matrix[4 * 3 + 1], 113) << "row 1 of column 3";
}

TEST(Messages, RecordsOfEveryCaseComeBackEqual) {
  for (const auto& line : test::read_jsonl("camera_cases.jsonl")) {
    const auto params = test::case_params_of(line["params"]);
    const auto constants = test::constants_of(line["constants"]);
    trk_bridge::CameraParams p;
    trk_bridge::CameraConstants c;
    to_msg(params, p);
    to_msg(constants, c);
    EXPECT_EQ(from_msg(p), params);
    EXPECT_EQ(from_msg(c), constants);
  }
}

TEST(Messages, ConstantsFieldByField) {
  wire::CameraConstants constants;
  constants = {3, 1920, 1080, 1, 2, 4, 5, 9.5, 5.25, 9.75, 5.5};
  trk_bridge::CameraConstants m;
  to_msg(constants, m);
  EXPECT_EQ((std::vector<std::int64_t>{m.id, m.image_width, m.image_height, m.blank_left, m.blank_right, m.blank_top,
                                       m.blank_bottom}),
            (std::vector<std::int64_t>{3, 1920, 1080, 1, 2, 4, 5}));
  EXPECT_EQ((std::vector<double>{m.chip_width, m.chip_height, m.fake_chip_width, m.fake_chip_height}),
            (std::vector<double>{9.5, 5.25, 9.75, 5.5}));
}

TEST(Messages, CalibrationAsCameraInfo) {
  camera::Calibration calibration;
  calibration.width = 1920;
  calibration.height = 1080;
  calibration.k = {2000, 0, 959.5, 0, 2001, 539.5, 0, 0, 1};
  calibration.distortion.d = {1, 2, 3, 4, 5, 6, 7, 8};
  sensor_msgs::CameraInfo info;
  to_msg(calibration, info);
  EXPECT_EQ(info.width, 1920u);
  EXPECT_EQ(info.height, 1080u);
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_THAT(info.D, ::testing::ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(info.R, ::testing::ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(info.P, ::testing::ElementsAre(2000, 0, 959.5, 0, 0, 2001, 539.5, 0, 0, 0, 1, 0));
  EXPECT_EQ(info.binning_x, 0u);

  calibration.distortion.model = camera::DistortionModel::rational_polynomial;
  to_msg(calibration, info);
  EXPECT_EQ(info.distortion_model, "rational_polynomial");
  EXPECT_THAT(info.D, ::testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(Messages, TimesToTheNanosecondFrom1970To2106) {
  EXPECT_EQ(to_time(1'700'000'000'083'456'789), ::ros::Time(1'700'000'000, 83'456'789));
  EXPECT_EQ(to_time(1), ::ros::Time(0, 1));
  EXPECT_EQ(to_time(4'294'967'295'999'999'999), ::ros::Time(4'294'967'295u, 999'999'999u));
  EXPECT_TRUE(to_time(0).isZero());
  EXPECT_TRUE(to_time(-1).isZero());
  EXPECT_TRUE(to_time(4'294'967'296'000'000'000).isZero());
}

}  // namespace trk_bridge::ros1::messages_test
