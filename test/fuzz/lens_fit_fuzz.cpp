// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Lenses and CameraInfos of any numbers: fits, both ways, and records through every format.
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bridge/camera_info.h"
#include "camera/figure.h"
#include "codec_claims.h"
#include "fuzz.h"
#include "same_camera.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/converter.h"

namespace {

using namespace trk_bridge;
using test::claim;
using test::Input;

/// Of a camera that could exist, or any number at all.
class Numbers {
 public:
  explicit Numbers(Input& input) : input_(input), are_valid_(input.below(4) != 0) {}

  bool are_valid() const { return are_valid_; }
  double between(double low, double high) {
    if (!are_valid_) return input_.number<double>();
    return low + (high - low) * input_.number<std::uint16_t>() / 65535;
  }
  std::int32_t whole(std::int32_t low, std::int32_t high) {
    if (!are_valid_) return input_.number<std::int32_t>();
    return low + input_.number<std::uint16_t>() % (high - low + 1);
  }

 private:
  Input& input_;
  bool are_valid_;
};

wire::CameraConstants constants_of(Numbers& numbers) {
  wire::CameraConstants c;
  c.image_width = numbers.whole(320, 8192);
  c.image_height = numbers.whole(240, 4320);
  c.blank_left = numbers.whole(0, 40);
  c.blank_right = numbers.whole(0, 40);
  c.blank_top = numbers.whole(0, 40);
  c.blank_bottom = numbers.whole(0, 40);
  c.chip_width = numbers.between(4, 36);
  c.chip_height = numbers.between(3, 24);
  c.fake_chip_width = numbers.between(4, 36);
  c.fake_chip_height = numbers.between(3, 24);
  return c;
}

camera::Lens lens_of(Numbers& numbers) {
  camera::Lens lens;
  lens.image_distance = numbers.between(3, 400);
  lens.center_shift = {numbers.between(-2, 2), numbers.between(-2, 2)};
  lens.k1 = numbers.between(-4e-3, 4e-3);
  lens.k2 = numbers.between(-2e-5, 2e-5);
  lens.focdist = numbers.between(0, 100);
  lens.aperture = numbers.between(0, 22);
  return lens;
}

void claim_lens(const camera::FittedLens& fitted) {
  const auto& lens = fitted.lens;
  claim(std::isfinite(lens.image_distance) && lens.image_distance > 0, "an image distance that no lens has");
  claim(lens.center_shift.allFinite() && std::isfinite(lens.k1) && std::isfinite(lens.k2), "a lens that is not finite");
  for (const double error : {fitted.residual, fitted.tangential, fitted.aspect}) {
    claim(std::isfinite(error) && error >= 0, "an error that is no number of pixels");
  }
}

/// What a CameraInfo says is a lens that can be sent, one that can be drawn, or a reason.
void claim_info(const bridge::CameraInfo& info, const wire::CameraConstants& chip) {
  if (const auto fitted = bridge::fit_lens(info, chip)) {
    claim_lens(*fitted);
    wire::CameraConstants constants = chip;
    constants.image_width = static_cast<std::int32_t>(info.width);
    constants.image_height = static_cast<std::int32_t>(info.height);
    const double reach = camera::image_reach(fitted->lens, camera::raster_of(constants));
    claim(camera::monotonic_radius(fitted->lens) >= reach * (1 - 1e-9), "a lens that folds within the image");
  } else {
    claim(!describe(fitted.error()).empty(), "refused without a reason");
  }
  const auto viewing = bridge::viewing_lens(info);
  if (!viewing) return;
  const auto border = camera::image_border(*viewing);
  if (!border) return claim(!camera::describe(border.error()).empty(), "not drawn without a reason");
  for (const Eigen::Vector3d& point : border->bent) claim(point.allFinite(), "a border that is not finite");
  for (const double angle : {border->horizontal, border->vertical, border->diagonal}) {
    claim(angle >= 0 && angle <= 180, "an angle of view that is none");
  }
}

/// Lens to CameraInfo and back: within the errors that both say.
void claim_calibration(Input& input) {
  Numbers numbers(input);
  const wire::CameraConstants constants = constants_of(numbers);
  const camera::Lens lens = lens_of(numbers);
  camera::Calibrator calibrator(input.flag() ? camera::plumb_bob_tolerance : std::numeric_limits<double>::infinity());
  const auto calibration = calibrator.calibrate(lens, constants);
  if (!calibration) {
    claim(!camera::describe(calibration.error()).empty(), "refused without a reason");
    return;
  }
  claim(calibration->k[0] > 0 && calibration->k[4] > 0, "a focal length that no camera has");
  claim(std::isfinite(calibration->distortion.residual) && calibration->distortion.residual >= 0, "no residual");
  bridge::CameraInfo info;
  info.width = calibration->width;
  info.height = calibration->height;
  info.distortion_model = camera::name(calibration->distortion.model);
  const auto& d = calibration->distortion.d;
  info.d.assign(d.begin(), d.begin() + (calibration->distortion.model == camera::DistortionModel::plumb_bob ? 5 : 8));
  info.k = calibration->k;
  claim_info(info, constants);
  const auto fitted = bridge::fit_lens(info, constants);
  if (!numbers.are_valid() || !fitted) return;
  const double worst = test::worst_pixel(fitted->lens, lens, constants);
  const double allowed = 0.05 + 3 * (calibration->distortion.residual + fitted->residual);
  claim(worst <= allowed, "another lens: " + std::to_string(worst) + " pixels, allowed are " + std::to_string(allowed));
}

void claim_any_info(Input& input) {
  Numbers numbers(input);
  bridge::CameraInfo info;
  info.width = static_cast<std::uint32_t>(numbers.whole(0, 8192));
  info.height = static_cast<std::uint32_t>(numbers.whole(0, 4320));
  const char* const models[] = {"plumb_bob", "rational_polynomial", "", "equidistant"};
  info.distortion_model = models[input.below(std::size(models))];
  const std::size_t counts[] = {0, 4, 5, 8, 3};
  info.d.resize(counts[input.below(std::size(counts))]);
  for (double& k : info.d) k = numbers.between(-0.6, 0.6);
  info.k = {numbers.between(300, 8000),
            0,
            numbers.between(0, 8192),
            0,
            numbers.between(300, 8000),
            numbers.between(0, 4320),
            0,
            0,
            1};
  if (input.below(8) == 0) info.k[input.below(9)] = input.number<double>();
  claim_info(info, constants_of(numbers));
}

void claim_undistortion(Input& input) {
  Numbers numbers(input);
  const wire::CameraConstants constants = constants_of(numbers);
  const camera::Lens lens = lens_of(numbers);
  camera::Undistortion distortion;
  for (double& k : distortion.numerator) k = numbers.between(-1e-2, 1e-2);
  for (double& k : distortion.denominator) k = numbers.between(-1e-2, 1e-2);
  if (const auto fitted = camera::fit_lens(lens, distortion, constants)) claim_lens(*fitted);
}

/// A record in another format, and back: the same camera.
void claim_formats(Input& input) {
  Numbers numbers(input);
  camera::Converter there(input.number<std::uint16_t>() & wire::known_format_bits);
  const wire::CameraConstants constants = constants_of(numbers);
  if (input.below(8) != 0) static_cast<void>(there.use(constants));
  camera::Camera camera;
  camera.lens = lens_of(numbers);
  camera.pose.linear() =
      camera::rotation_of({numbers.between(-180, 180), numbers.between(-90, 90), numbers.between(-180, 180)});
  camera.pose.translation() =
      Eigen::Vector3d(numbers.between(-50, 50), numbers.between(-50, 50), numbers.between(-5, 50));
  const std::uint32_t format = input.number<std::uint16_t>() & wire::known_format_bits;
  const auto params = camera::encode(camera, format, there.incoming());
  if (!params) {
    claim(!camera::describe(params.error()).empty(), "refused without a reason");
    return;
  }
  if (!test::all_finite(*params)) return claim(!numbers.are_valid(), "parameters that are not finite");
  const auto converted = there.convert(*params);
  if (!converted.params) {
    claim(!camera::describe(converted.params.error()).empty(), "refused without a reason");
    return;
  }
  claim(test::all_finite(*converted.params), "a number is not finite");
  const auto back = camera::decode(*converted.params, there.outgoing());
  if (!numbers.are_valid()) return;
  claim(back.has_value(), "parameters that cannot be read");
  claim(back->pose.isApprox(camera.pose, 1e-9), "another pose");
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-7 * (1 + std::abs(b)); };
  claim(near(back->lens.image_distance, camera.lens.image_distance) &&
            near(back->lens.center_shift.x(), camera.lens.center_shift.x()) &&
            near(back->lens.center_shift.y(), camera.lens.center_shift.y()) && back->lens.k1 == camera.lens.k1 &&
            back->lens.k2 == camera.lens.k2 && back->lens.focdist == camera.lens.focdist,
        "another lens");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  switch (input.below(4)) {
    case 0:
      claim_calibration(input);
      break;
    case 1:
      claim_any_info(input);
      break;
    case 2:
      claim_undistortion(input);
      break;
    case 3:
      claim_formats(input);
      break;
  }
  return 0;
}
