// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "figure.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "numeric.h"
#include "opencv_lens.h"

namespace trk_bridge::camera {
namespace {

constexpr std::size_t edge = border_points_an_edge;

/// Pixels of the border in the order of ImageBorder::bent.
std::array<Eigen::Vector2d, 4 * edge> border_pixels(double width, double height) noexcept {
  std::array<Eigen::Vector2d, 4 * edge> pixels;
  for (std::size_t i = 0; i < edge; ++i) {
    const double fraction = static_cast<double>(i) / edge;
    const Eigen::Vector2d forth(width * fraction, height * fraction);
    const Eigen::Vector2d back(width * (1 - fraction), height * (1 - fraction));
    pixels[i] = {forth.x(), 0};
    pixels[edge + i] = {width, forth.y()};
    pixels[2 * edge + i] = {back.x(), height};
    pixels[3 * edge + i] = {0, back.y()};
  }
  for (auto& pixel : pixels) pixel.array() -= 0.5;
  return pixels;
}

/// Accurate for small angles, too.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) noexcept {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * degrees_per_radian;
}

void measure_angles(ImageBorder& border) noexcept {
  const auto middle = [&border](std::size_t side) { return border.bent[side * edge + edge / 2]; };
  border.horizontal = angle_between(middle(3), middle(1));
  border.vertical = angle_between(middle(0), middle(2));
  border.diagonal = angle_between(border.corners[0], border.corners[2]);
}

template <typename Point>
void append_line(std::vector<Eigen::Vector3d>& lines, const Point& from, const Point& to) {
  lines.push_back(from);
  lines.push_back(to);
}

/// A point from which all of the border is visible: the optical axis if it is in the image, because distortion is
/// radial from there, else the centre of the border.
Eigen::Vector3d middle_of(const ImageBorder& border) noexcept {
  const Eigen::Vector3d& first = border.straight[0];
  const Eigen::Vector3d& last = border.straight[2];
  if (first.x() < 0 && first.y() < 0 && last.x() > 0 && last.y() > 0) return Eigen::Vector3d::UnitZ();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : border.bent) sum += point;
  return sum / static_cast<double>(border.bent.size());
}

}  // namespace

bool operator==(const ViewingLens& a, const ViewingLens& b) noexcept {
  return a.k == b.k && a.d == b.d && a.width == b.width && a.height == b.height;
}

bool operator!=(const ViewingLens& a, const ViewingLens& b) noexcept { return !(a == b); }

Result<ImageBorder> image_border(const ViewingLens& viewing) noexcept {
  const Result<OpenCvLens> lens = opencv_lens(viewing.k, viewing.d);
  if (!lens) return tl::unexpected(lens.error());
  if (viewing.width == 0 || viewing.height == 0) return tl::unexpected(CameraReason::bad_calibration);
  auto distorted = border_pixels(viewing.width, viewing.height);
  double reach = 0;
  for (auto& point : distorted) {
    point = lens->on_image(point);
    reach = std::max(reach, point.norm());
  }
  const double widest = std::tan(widest_drawn_angle / degrees_per_radian);
  if (!(reach <= widest)) return tl::unexpected(CameraReason::too_wide);
  const Result<LensInverse> inverse = LensInverse::over(*lens, reach);
  if (!inverse) return tl::unexpected(inverse.error());

  ImageBorder border;
  for (std::size_t i = 0; i < distorted.size(); ++i) {
    const Result<Eigen::Vector2d> point = inverse->undistorted(distorted[i]);
    if (!point) return tl::unexpected(point.error());
    if (!(point->norm() <= widest)) return tl::unexpected(CameraReason::too_wide);
    border.bent[i] = point->homogeneous();
  }
  for (std::size_t i = 0; i < border.corners.size(); ++i) {
    border.corners[i] = border.bent[i * edge];
    border.straight[i] = distorted[i * edge].homogeneous();
  }
  measure_angles(border);
  if (!(border.horizontal > 0 && border.vertical > 0)) return tl::unexpected(CameraReason::bad_calibration);
  return border;
}

std::vector<Eigen::Vector3d> frustum_lines(const ImageBorder& border, double near, double far) {
  std::vector<Eigen::Vector3d> lines;
  lines.reserve(2 * (2 * border.bent.size() + border.corners.size()));
  for (const double depth : {near, far}) {
    for (std::size_t i = 0; i < border.bent.size(); ++i) {
      append_line(lines, border.bent[i] * depth, border.bent[(i + 1) % border.bent.size()] * depth);
    }
  }
  for (const auto& corner : border.corners) append_line(lines, corner * near, corner * far);
  return lines;
}

std::vector<Eigen::Vector3d> outline_at(const ImageBorder& border, double depth) {
  std::vector<Eigen::Vector3d> outline;
  outline.reserve(border.bent.size() + 1);
  for (const auto& point : border.bent) outline.push_back(point * depth);
  outline.push_back(outline.front());
  return outline;
}

std::vector<Eigen::Vector3d> area_at(const ImageBorder& border, double depth) {
  const Eigen::Vector3d middle = middle_of(border) * depth;
  std::vector<Eigen::Vector3d> triangles;
  triangles.reserve(3 * border.bent.size());
  for (std::size_t i = 0; i < border.bent.size(); ++i) {
    triangles.push_back(middle);
    triangles.push_back(border.bent[i] * depth);
    triangles.push_back(border.bent[(i + 1) % border.bent.size()] * depth);
  }
  return triangles;
}

}  // namespace trk_bridge::camera
