// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A picture of the 3D view, measured by colour.
#pragma once

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <Eigen/Core>
#include <QColor>
#include <QImage>

namespace trk_bridge::test {

/// Points on a line from one to the next, in pixels from the upper left corner of the picture.
using Polyline = std::vector<Eigen::Vector2d>;

class Picture {
 public:
  explicit Picture(QImage image) : image_(std::move(image)) {}

  const QImage& image() const { return image_; }

  /// The middles of all pixels of that colour, to a few steps of 255.
  std::vector<Eigen::Vector2d> pixels(const QColor& colour) const;

  /// Whether a pixel of that colour is no farther than `radius` pixels from `at`.
  bool has(const QColor& colour, const Eigen::Vector2d& at, double radius) const;

  /// Whether all of the lines are there in that colour, to `tolerance` pixels, and nothing else is.
  ::testing::AssertionResult shows_only(const QColor& colour, const std::vector<Polyline>& lines,
                                        double tolerance) const;

  /// As a PNG file, with the lines drawn over it where there are some.
  void write(const std::string& path, const std::vector<Polyline>& lines = {}) const;

 private:
  bool is(const QColor& colour, int x, int y) const;

  QImage image_;
};

/// To the nearest point of the line.
double distance(const Eigen::Vector2d& point, const Polyline& line);

}  // namespace trk_bridge::test
