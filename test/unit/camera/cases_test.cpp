// The worked cases, both ways.
#include <gmock/gmock.h>

#include <cmath>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::camera {
namespace {

constexpr double tolerance = 1e-9;

void expect_near(double actual, double expected, const std::string& what) {
  EXPECT_LE(std::abs(actual - expected), tolerance * std::max(1.0, std::abs(expected)))
      << what << ": " << actual << " instead of " << expected;
}

void expect_angle(double actual, double expected, const std::string& what) {
  EXPECT_LE(std::abs(std::remainder(actual - expected, 360.0)), tolerance * std::max(1.0, std::abs(expected)))
      << what << ": " << actual << " instead of " << expected;
}

Camera expected_camera(const rapidjson::Value& line) {
  const auto& expect = line["expect"];
  Camera camera;
  for (rapidjson::SizeType i = 0; i < 16; ++i) {
    camera.pose.matrix()(i / 4, i % 4) = expect["studio_T_camera_rows"][i].GetDouble();
  }
  camera.lens.image_distance = expect["image_distance_mm"].GetDouble();
  camera.lens.center_shift = {expect["center_shift_mm"][0].GetDouble(), expect["center_shift_mm"][1].GetDouble()};
  camera.lens.k1 = line["params"]["k1"].GetDouble();
  camera.lens.k2 = line["params"]["k2"].GetDouble();
  camera.lens.focdist = line["params"]["focdist"].GetDouble();
  camera.lens.aperture = line["params"]["aperture"].GetDouble();
  return camera;
}

TEST(WorkedCases, DecodeToTheExpectedCamera) {
  for (const auto& line : test::read_jsonl("camera_cases.jsonl")) {
    SCOPED_TRACE("mask " + std::to_string(line["mask"].GetUint()));
    const auto constants = test::constants_of(line["constants"]);
    const auto camera = decode(test::case_params_of(line["params"]), &constants);
    ASSERT_TRUE(camera) << describe(camera.error());
    const Camera expected = expected_camera(line);
    for (int i = 0; i < 16; ++i) {
      expect_near(camera->pose.matrix()(i / 4, i % 4), expected.pose.matrix()(i / 4, i % 4),
                  "pose element " + std::to_string(i));
    }
    const PanTiltRoll angles = pan_tilt_roll(camera->pose.linear());
    const auto& euler = line["expect"]["euler"];
    expect_near(camera->pose.translation().x(), euler["x"].GetDouble(), "x");
    expect_near(camera->pose.translation().y(), euler["y"].GetDouble(), "y");
    expect_near(camera->pose.translation().z(), euler["z"].GetDouble(), "z");
    expect_angle(angles.pan, euler["pan"].GetDouble(), "pan");
    expect_angle(angles.tilt, euler["tilt"].GetDouble(), "tilt");
    expect_angle(angles.roll, euler["roll"].GetDouble(), "roll");
    expect_near(camera->lens.image_distance, expected.lens.image_distance, "image distance");
    expect_near(camera->lens.center_shift.x(), expected.lens.center_shift.x(), "centre shift x");
    expect_near(camera->lens.center_shift.y(), expected.lens.center_shift.y(), "centre shift y");
    EXPECT_EQ(camera->lens.k1, expected.lens.k1);
    EXPECT_EQ(camera->lens.k2, expected.lens.k2);
    EXPECT_EQ(camera->lens.focdist, expected.lens.focdist);
    EXPECT_EQ(camera->lens.aperture, expected.lens.aperture);
  }
}

TEST(WorkedCases, EncodeToTheParametersOfTheSender) {
  for (const auto& line : test::read_jsonl("camera_cases.jsonl")) {
    const std::uint32_t mask = line["mask"].GetUint();
    SCOPED_TRACE("mask " + std::to_string(mask));
    const auto constants = test::constants_of(line["constants"]);
    const auto params = encode(expected_camera(line), mask, &constants);
    ASSERT_TRUE(params) << describe(params.error());
    const wire::CameraParams expected = test::case_params_of(line["params"]);
    EXPECT_EQ(params->format, mask);
    if (wire::has(mask, wire::euler)) {
      expect_near(params->euler.x, expected.euler.x, "x");
      expect_near(params->euler.y, expected.euler.y, "y");
      expect_near(params->euler.z, expected.euler.z, "z");
      expect_angle(params->euler.pan, expected.euler.pan, "pan");
      expect_angle(params->euler.tilt, expected.euler.tilt, "tilt");
      expect_angle(params->euler.roll, expected.euler.roll, "roll");
    } else {
      for (std::size_t i = 0; i < 16; ++i) {
        expect_near(params->matrix[i], expected.matrix[i], "matrix element " + std::to_string(i));
      }
    }
    expect_near(params->fov, expected.fov, "fov");
    expect_near(params->center_x, expected.center_x, "centerX");
    expect_near(params->center_y, expected.center_y, "centerY");
    EXPECT_EQ(params->k1, expected.k1);
    EXPECT_EQ(params->k2, expected.k2);
    EXPECT_EQ(params->focdist, expected.focdist);
    EXPECT_EQ(params->aperture, expected.aperture);
  }
}

}  // namespace
}  // namespace trk_bridge::camera
