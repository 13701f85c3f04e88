// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures how near ROS's distortion models come to lenses of the document, and the way back, as tables in CSV:
// lens_fit there|back.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

#include <Eigen/QR>

#include "camera/radial_fit.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/image.h"

namespace {

using namespace trk_bridge;
using camera::Lens;

const wire::CameraConstants hd{0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 0, 0};
constexpr double image_distance = 8;  // mm
const double corner = std::hypot(hd.chip_width, hd.chip_height) / 2;

/// A lens whose corner of the picture is undistorted to `at_corner` times its radius, `share` of that by k1.
Lens lens_with(double at_corner, double share) {
  const double squared = corner * corner;
  Lens lens;
  lens.image_distance = image_distance;
  lens.k1 = (at_corner - 1) * share / squared;
  lens.k2 = (at_corner - 1) * (1 - share) / (squared * squared);
  return lens;
}

template <typename T>
const T& or_exit(const camera::Result<T>& result) {
  if (!result) {
    std::fprintf(stderr, "lens_fit: %s\n", camera::describe(result.error()).c_str());
    std::exit(1);
  }
  return *result;
}

double undistorted(const Lens& lens, double radius) { return camera::undistort(lens, {radius, 0}).x(); }

/// Worst error in pixels over the picture of `model`, whose radii are in units of the corner's undistorted one.
double worst_error(const Lens& lens, const camera::RadialModel& model) {
  constexpr int probes = 2000;
  const camera::Raster raster = camera::raster_of(hd);
  const double unit = undistorted(lens, corner);
  double worst = 0;
  for (int i = 1; i <= probes; ++i) {
    const double radius = corner * i / probes;
    worst = std::max(worst, std::abs(model.distorted(undistorted(lens, radius) / unit).value * unit - radius));
  }
  return worst * std::max(raster.mx, raster.my);
}

/// What the bridge fits, with plumb_bob as long as it is not worse than `tolerance`.
double fitted(const Lens& lens, double tolerance) {
  const double unit = undistorted(lens, corner);
  const auto fit = camera::fit_radial(lens.k1 * unit * unit, lens.k2 * std::pow(unit, 4), corner / unit, tolerance);
  return worst_error(lens, or_exit(fit).radial);
}

/// plumb_bob without k3, fitted in the same way. The bridge never publishes it.
double two_coefficients(const Lens& lens) {
  constexpr int nodes = 48;
  Eigen::Matrix<double, nodes, 2> terms;
  Eigen::Matrix<double, nodes, 1> wanted;
  const double unit = undistorted(lens, corner);
  for (int i = 0; i < nodes; ++i) {
    const double radius = corner * std::sin((i + 0.5) * (M_PI_2 / nodes));
    const double r = undistorted(lens, radius) / unit;
    terms.row(i) << r * r * r, std::pow(r, 5);
    wanted[i] = radius / unit - r;
  }
  const Eigen::Vector2d k = terms.colPivHouseholderQr().solve(wanted);
  return worst_error(lens, {{k[0], k[1], 0, 0, 0, 0}});
}

/// The lens as CameraInfo and back: the worst difference of the two lenses over the picture, pixels.
double there_and_back(const Lens& lens) {
  camera::Calibrator calibrator;
  const auto there = calibrator.calibrate(lens, hd);
  const auto& d = or_exit(there).distortion.d;
  const auto back = camera::fit_lens(there->k, std::vector<double>(d.begin(), d.end()), hd);
  const camera::Raster raster = camera::raster_of(hd);
  double worst = 0;
  for (int i = 1; i <= 400; ++i) {
    const double radius = corner * i / 400;
    const auto seen = camera::distort(or_exit(back).lens, {undistorted(lens, radius), 0});
    worst = std::max(worst, std::abs(or_exit(seen).x() - radius));
  }
  return worst * std::max(raster.mx, raster.my);
}

void print_there() {
  std::puts("lens,u_at_corner,share_of_k1,plumb_bob_2,plumb_bob_3,rational_polynomial,there_and_back");
  const auto row = [](const char* table, double at_corner, double share) {
    const Lens lens = lens_with(at_corner, share);
    std::printf("%s,%.3f,%.2f,%.6f,%.6f,%.6f,%.6f\n", table, at_corner, share, two_coefficients(lens),
                fitted(lens, std::numeric_limits<double>::infinity()), fitted(lens, 0), there_and_back(lens));
  };
  constexpr std::array<std::array<double, 2>, 5> worked{
      {{1.003, 0.5}, {1.041, 0.3}, {0.925, 0.92}, {1.257, 0.5}, {0.843, 0.85}}};
  for (const auto& [at_corner, share] : worked) row("worked", at_corner, share);
  for (int percent = -18; percent <= 30; ++percent) {
    if (percent == 0) continue;
    for (const double share : {1.0, 0.5}) row("sweep", 1 + percent / 100.0, share);
  }
}

/// The way back from lenses that ROS's own calibration gives: plumb_bob with k1 alone.
void print_back() {
  std::puts("distorted_over_undistorted,k1,residual");
  const camera::Raster raster = camera::raster_of(hd);
  for (int percent = -20; percent <= 20; percent += 2) {
    if (percent == 0) continue;
    const double ratio = 1 + percent / 100.0;
    const double radius = corner / image_distance / ratio;  // of the corner, undistorted
    const double k1 = (ratio - 1) / (radius * radius);
    const std::array<double, 9> k = {
        raster.mx * image_distance, 0, 959.5, 0, raster.my * image_distance, 539.5, 0, 0, 1};
    const auto back = camera::fit_lens(k, {k1, 0, 0, 0, 0}, hd);
    std::printf("%.2f,%.4f,%.6f\n", ratio, k1, or_exit(back).residual);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view table = argc == 2 ? argv[1] : "";
  if (table == "there") {
    print_there();
  } else if (table == "back") {
    print_back();
  } else {
    std::fputs("usage: lens_fit there|back\n", stderr);
    return 2;
  }
}
