// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Finds the centres of discs and lines in grey pictures without knowledge of how they were drawn.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace trk_bridge::test {

/// Bright discs and lines on a dark ground: levels of grey, sizes in pixels.
struct Looks {
  double ground = 30;       ///< level between them
  double tolerance = 5;     ///< of the ground's level
  double disc_level = 230;  ///< only discs are at least this bright
  double disc_reach = 10.5;
  double disc_clearance = 12;  ///< between the two radii there is only ground around a disc
  double line_contrast = 60;   ///< least contrast of lines
  double line_reach = 5;
  double line_clearance = 7.5;  ///< between the two distances there is only ground beside a line
};

/// Interpolated; the picture must contain the surrounding pixels.
inline double level_at(const cv::Mat& picture, const Eigen::Vector2d& pixel) {
  const int u = static_cast<int>(std::floor(pixel.x())), v = static_cast<int>(std::floor(pixel.y()));
  const double right = pixel.x() - u, below = pixel.y() - v;
  const auto* upper = picture.ptr<std::uint8_t>(v) + u;
  const auto* lower = picture.ptr<std::uint8_t>(v + 1) + u;
  return (1 - below) * ((1 - right) * upper[0] + right * upper[1]) +
         below * ((1 - right) * lower[0] + right * lower[1]);
}

inline bool is_inside(const cv::Mat& picture, const Eigen::Vector2d& pixel, double margin) {
  return pixel.x() >= margin && pixel.y() >= margin && pixel.x() < picture.cols - 1 - margin &&
         pixel.y() < picture.rows - 1 - margin;
}

/// Centroid of the disc around `near`; none if it is not surrounded by ground.
inline std::optional<Eigen::Vector2d> disc_center(const cv::Mat& picture, const Eigen::Vector2d& near,
                                                  const Looks& looks = {}) {
  if (!is_inside(picture, near, looks.disc_clearance + 1)) return std::nullopt;
  const int u = static_cast<int>(std::lround(near.x())), v = static_cast<int>(std::lround(near.y()));
  const int around = static_cast<int>(looks.disc_clearance);
  double weight = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int j = v - around; j <= v + around; ++j) {
    for (int i = u - around; i <= u + around; ++i) {
      const double distance = std::hypot(i - near.x(), j - near.y());
      if (distance > looks.disc_clearance) continue;
      const double above = picture.at<std::uint8_t>(j, i) - looks.ground;
      if (distance >= looks.disc_reach) {
        if (std::abs(above) > looks.tolerance) return std::nullopt;
        continue;
      }
      weight += above;
      moment += above * Eigen::Vector2d(i, j);
    }
  }
  return moment / weight;
}

/// All discs that touch nothing else.
inline std::vector<Eigen::Vector2d> disc_centers(const cv::Mat& picture, const Looks& looks = {}) {
  cv::Mat bright, labels, statistics, centroids;
  cv::threshold(picture, bright, looks.disc_level, 255, cv::THRESH_BINARY);
  const int count = cv::connectedComponentsWithStats(bright, labels, statistics, centroids);
  std::vector<Eigen::Vector2d> centers;
  for (int i = 1; i < count; ++i) {
    const auto center = disc_center(picture, {centroids.at<double>(i, 0), centroids.at<double>(i, 1)}, looks);
    if (center) centers.push_back(*center);
  }
  return centers;
}

/// Where a line was crossed.
struct Crossing {
  Eigen::Vector2d center;  ///< the middle of the line
  double weight = 0;       ///< sum of its levels over the ground
};

/// Of the line that passes by `near`, along `normal` (a unit vector); none if there is no line, or not ground on both
/// sides of it.
inline std::optional<Crossing> cross_line(const cv::Mat& picture, const Eigen::Vector2d& near,
                                          const Eigen::Vector2d& normal, const Looks& looks = {}) {
  if (!is_inside(picture, near, looks.line_clearance + 1)) return std::nullopt;
  constexpr double step = 0.125;
  double weight = 0, moment = 0, highest = 0;
  const int steps = static_cast<int>(looks.line_clearance / step);
  for (int i = -steps; i <= steps; ++i) {
    const double aside = i * step;
    const double above = level_at(picture, near + aside * normal) - looks.ground;
    if (above < -looks.tolerance) return std::nullopt;
    if (std::abs(aside) > looks.line_reach) {
      if (above > looks.tolerance) return std::nullopt;
      continue;
    }
    weight += above;
    moment += above * aside;
    highest = std::max(highest, above);
  }
  if (highest < looks.line_contrast) return std::nullopt;
  return Crossing{near + moment / weight * normal, weight};
}

/// Which of the crossings have the weight of their neighbours: where something else covers half of a line, its middle
/// is wrong.
inline std::vector<bool> are_whole(const std::vector<std::optional<Crossing>>& crossings) {
  constexpr std::size_t around = 12;
  constexpr double tolerance = 0.015;
  std::vector<bool> whole(crossings.size());
  std::vector<double> weights;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (!crossings[i]) continue;
    weights.clear();
    for (std::size_t j = i < around ? 0 : i - around; j < std::min(crossings.size(), i + around + 1); ++j) {
      if (crossings[j]) weights.push_back(crossings[j]->weight);
    }
    const auto middle = weights.begin() + static_cast<std::ptrdiff_t>(weights.size() / 2);
    std::nth_element(weights.begin(), middle, weights.end());
    whole[i] = std::abs(crossings[i]->weight - *middle) <= tolerance * *middle;
  }
  return whole;
}

/// Middles of the crossings that are complete, and whose neighbours are complete.
inline std::vector<Eigen::Vector2d> whole_centers(const std::vector<std::optional<Crossing>>& crossings) {
  constexpr std::size_t next = 2;
  const std::vector<bool> whole = are_whole(crossings);
  std::vector<Eigen::Vector2d> centers;
  for (std::size_t i = next; i + next < crossings.size(); ++i) {
    const auto at = [&](std::size_t index) { return whole.begin() + static_cast<std::ptrdiff_t>(index); };
    if (std::all_of(at(i - next), at(i + next + 1), [](bool one) { return one; })) {
      centers.push_back(crossings[i]->center);
    }
  }
  return centers;
}

/// Middles of a line every few pixels along its expected place, which is right to a pixel or two.
inline std::vector<Eigen::Vector2d> line_centers(const cv::Mat& picture, const std::vector<Eigen::Vector2d>& expected,
                                                 const Looks& looks = {}) {
  constexpr double every = 5.3;  // pixels: gives all fractions of a pixel
  std::vector<std::optional<Crossing>> crossings;
  for (std::size_t i = 1; i < expected.size(); ++i) {
    const Eigen::Vector2d along = expected[i] - expected[i - 1];
    const double length = along.norm();
    if (!(length > 0)) continue;
    const Eigen::Vector2d direction = along / length;
    // Only the part that can be inside: expected lines may be infinite.
    const double middle = (Eigen::Vector2d(picture.cols, picture.rows) / 2 - expected[i - 1]).dot(direction);
    const double half = std::hypot(picture.cols, picture.rows) / 2;
    const double begin = std::max(0.0, middle - half), end = std::min(length, middle + half);
    for (double run = begin; run < end; run += every) {
      crossings.push_back(
          cross_line(picture, expected[i - 1] + run * direction, {-direction.y(), direction.x()}, looks));
    }
  }
  return whole_centers(crossings);
}

/// The largest distance of a point from the straight line that fits the points best.
inline double deviation_from_straight(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& point : points) spread += (point - mean) * (point - mean).transpose();
  const Eigen::Vector2d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(0);
  double most = 0;
  for (const auto& point : points) most = std::max(most, std::abs(normal.dot(point - mean)));
  return most;
}

}  // namespace trk_bridge::test
