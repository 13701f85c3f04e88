// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The time that a sample takes in the module camera.
#include <benchmark/benchmark.h>

#include "camera/figure.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/converter.h"
#include "trk_bridge/camera/image.h"
#include "trk_bridge/wire/format.h"

namespace {

using namespace trk_bridge;

const wire::CameraConstants constants{0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 0, 0};
const camera::Lens mild{8, {0.01, -0.02}, -3e-4, -1e-6, 5, 2.8};
const camera::Lens strong{8, {0.01, -0.02}, -1.5e-3, -2e-5, 5, 2.8};

camera::Camera some_camera(const camera::Lens& lens) {
  camera::Camera camera;
  camera.pose.linear() = camera::rotation_of({31, -12, 3});
  camera.pose.translation() = Eigen::Vector3d(1, -2, 1.5);
  camera.lens = lens;
  return camera;
}

constexpr std::uint32_t angles = wire::euler;
constexpr std::uint32_t everything = wire::studio_to_camera | wire::camera_y_up | wire::studio_y_up |
                                     wire::field_of_view | wire::diagonal | wire::ignore_blank | wire::keep_aspect |
                                     wire::shift_in_pixels;

void decode(benchmark::State& state) {
  const auto params = camera::encode(some_camera(mild), static_cast<std::uint32_t>(state.range(0)), &constants).value();
  for (auto _ : state) benchmark::DoNotOptimize(camera::decode(params, &constants));
}
BENCHMARK(decode)->ArgName("format")->Arg(angles)->Arg(0)->Arg(everything);

void encode(benchmark::State& state) {
  const camera::Camera camera = some_camera(mild);
  const auto format = static_cast<std::uint32_t>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(camera::encode(camera, format, &constants));
}
BENCHMARK(encode)->ArgName("format")->Arg(angles)->Arg(0)->Arg(everything);

void convert(benchmark::State& state) {
  const auto params = camera::encode(some_camera(mild), everything, &constants).value();
  camera::Converter converter(static_cast<std::uint32_t>(state.range(0)));
  if (converter.use(constants) != camera::ConstantsChange::changed) state.SkipWithError("bad constants");
  for (auto _ : state) benchmark::DoNotOptimize(converter.convert(params));
}
BENCHMARK(convert)->ArgName("format")->Arg(angles)->Arg(everything);

void calibrate_kept(benchmark::State& state) {
  camera::Calibrator calibrator;
  for (auto _ : state) benchmark::DoNotOptimize(calibrator.calibrate(strong, constants));
  if (calibrator.fits() != 1) state.SkipWithError("the fit was not kept");
}
BENCHMARK(calibrate_kept);

void calibrate_new_lens(benchmark::State& state, camera::Lens lens) {
  camera::Calibrator calibrator;
  const double k1 = lens.k1;
  int step = 0;
  for (auto _ : state) {
    lens.k1 = k1 * (1 + 1e-6 * (++step % 1000));
    benchmark::DoNotOptimize(calibrator.calibrate(lens, constants));
  }
}
BENCHMARK_CAPTURE(calibrate_new_lens, plumb_bob, mild);
BENCHMARK_CAPTURE(calibrate_new_lens, rational_polynomial, strong);

void distort(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(camera::distort(strong, {3, 2}));
}
BENCHMARK(distort);

void fit_lens(benchmark::State& state) {
  camera::Calibrator calibrator;
  const auto calibration = calibrator.calibrate(strong, constants).value();
  const std::vector<double> d(calibration.distortion.d.begin(), calibration.distortion.d.end());
  for (auto _ : state) benchmark::DoNotOptimize(camera::fit_lens(calibration.k, d, constants));
}
BENCHMARK(fit_lens);

void image_border(benchmark::State& state, double tangential) {
  camera::Calibrator calibrator;
  const auto calibration = calibrator.calibrate(strong, constants).value();
  camera::ViewingLens lens{calibration.k, {}, calibration.width, calibration.height};
  lens.d.assign(calibration.distortion.d.begin(), calibration.distortion.d.end());
  lens.d[2] = lens.d[3] = tangential;
  for (auto _ : state) benchmark::DoNotOptimize(camera::image_border(lens));
}
BENCHMARK_CAPTURE(image_border, radial, 0);
BENCHMARK_CAPTURE(image_border, tangential, 1e-3);

}  // namespace

BENCHMARK_MAIN();
