// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The worked cases as cameras and points.
#pragma once

#include <string>
#include <vector>

#include "trk_bridge/camera/camera.h"
#include "vectors.h"

namespace trk_bridge::test {

struct Point {
  Eigen::Vector3d studio, camera;
  Eigen::Vector2d pinhole, distorted;
};

struct WorkedCase {
  std::uint32_t mask = 0;
  wire::CameraConstants constants;
  wire::CameraParams params;
  camera::Camera camera;
  camera::PanTiltRoll angles;
  std::array<double, 9> k{};
  std::vector<Point> points;
};

template <int size>
Eigen::Matrix<double, size, 1> vector_of(const rapidjson::Value& v) {
  Eigen::Matrix<double, size, 1> vector;
  for (int i = 0; i < size; ++i) vector[i] = v[static_cast<rapidjson::SizeType>(i)].GetDouble();
  return vector;
}

inline WorkedCase worked_case_of(const rapidjson::Value& line) {
  const auto& expect = line["expect"];
  WorkedCase c;
  c.mask = line["mask"].GetUint();
  c.constants = constants_of(line["constants"]);
  c.params = case_params_of(line["params"]);
  for (rapidjson::SizeType i = 0; i < 16; ++i) {
    c.camera.pose.matrix()(i / 4, i % 4) = expect["studio_T_camera_rows"][i].GetDouble();
  }
  c.angles = {expect["euler"]["pan"].GetDouble(), expect["euler"]["tilt"].GetDouble(),
              expect["euler"]["roll"].GetDouble()};
  c.camera.lens = {expect["image_distance_mm"].GetDouble(),
                   vector_of<2>(expect["center_shift_mm"]),
                   c.params.k1,
                   c.params.k2,
                   c.params.focdist,
                   c.params.aperture};
  for (rapidjson::SizeType i = 0; i < 9; ++i) c.k[i] = expect["K"][i].GetDouble();
  for (const auto& point : expect["points"].GetArray()) {
    c.points.push_back({vector_of<3>(point["studio"]), vector_of<3>(point["camera"]),
                        vector_of<2>(point["pixel_pinhole"]), vector_of<2>(point["pixel_distorted"])});
  }
  return c;
}

inline std::vector<WorkedCase> worked_cases() {
  std::vector<WorkedCase> cases;
  for (const auto& line : read_jsonl("camera_cases.jsonl")) cases.push_back(worked_case_of(line));
  return cases;
}

}  // namespace trk_bridge::test
