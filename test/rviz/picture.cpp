// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <QPainter>
#include <QString>

namespace trk_bridge::test {
namespace {

constexpr int colour_tolerance = 4;

double distance(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double length = along.squaredNorm();
  const double at = length == 0 ? 0 : std::clamp((point - from).dot(along) / length, 0.0, 1.0);
  return (point - from - at * along).norm();
}

/// Points of the line, a pixel apart or closer.
Polyline sampled(const Polyline& line) {
  Polyline points{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const int steps = std::max(1, static_cast<int>(std::ceil((line[i] - line[i - 1]).norm())));
    for (int k = 1; k <= steps; ++k) points.push_back(line[i - 1] + (line[i] - line[i - 1]) * (double(k) / steps));
  }
  return points;
}

std::string name(const QColor& colour) { return colour.name().toStdString(); }

}  // namespace

double distance(const Eigen::Vector2d& point, const Polyline& line) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) nearest = std::min(nearest, distance(point, line[i - 1], line[i]));
  return nearest;
}

bool Picture::is(const QColor& colour, int x, int y) const {
  const QRgb pixel = image_.pixel(x, y);
  return std::abs(qRed(pixel) - colour.red()) <= colour_tolerance &&
         std::abs(qGreen(pixel) - colour.green()) <= colour_tolerance &&
         std::abs(qBlue(pixel) - colour.blue()) <= colour_tolerance;
}

std::vector<Eigen::Vector2d> Picture::pixels(const QColor& colour) const {
  std::vector<Eigen::Vector2d> found;
  for (int y = 0; y < image_.height(); ++y) {
    for (int x = 0; x < image_.width(); ++x) {
      if (is(colour, x, y)) found.emplace_back(x + 0.5, y + 0.5);
    }
  }
  return found;
}

bool Picture::has(const QColor& colour, const Eigen::Vector2d& at, double radius) const {
  const Eigen::Vector2i low = (at.array() - radius - 1).floor().cast<int>().cwiseMax(0);
  const Eigen::Vector2i high =
      (at.array() + radius + 1).ceil().cast<int>().cwiseMin(Eigen::Array2i(image_.width(), image_.height()));
  for (int y = low.y(); y < high.y(); ++y) {
    for (int x = low.x(); x < high.x(); ++x) {
      if (is(colour, x, y) && (Eigen::Vector2d(x + 0.5, y + 0.5) - at).norm() <= radius) return true;
    }
  }
  return false;
}

::testing::AssertionResult Picture::shows_only(const QColor& colour, const std::vector<Polyline>& lines,
                                               double tolerance) const {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const auto& point : sampled(lines[i])) {
      if (!has(colour, point, tolerance)) {
        return ::testing::AssertionFailure() << "line " << i << ": no " << name(colour) << " at " << point.transpose();
      }
    }
  }
  for (const auto& pixel : pixels(colour)) {
    const bool wanted = std::any_of(lines.begin(), lines.end(),
                                    [&](const Polyline& line) { return distance(pixel, line) <= tolerance; });
    if (!wanted)
      return ::testing::AssertionFailure() << name(colour) << " at " << pixel.transpose() << ", where no line is";
  }
  return ::testing::AssertionSuccess();
}

void Picture::write(const std::string& path, const std::vector<Polyline>& lines) const {
  QImage copy = image_.convertToFormat(QImage::Format_RGB32);
  QPainter painter(&copy);
  painter.setPen(Qt::green);
  for (const auto& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      painter.drawLine(QPointF(line[i - 1].x(), line[i - 1].y()), QPointF(line[i].x(), line[i].y()));
    }
  }
  painter.end();
  if (!copy.save(QString::fromStdString(path))) throw std::runtime_error("cannot write " + path);
}

}  // namespace trk_bridge::test
