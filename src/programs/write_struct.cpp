#include "write_struct.h"

#include <cmath>
#include <iostream>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "pacing.h"
#include "cli/stop_signals.h"
#include "c_api/records.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::programs {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::chrono::milliseconds field_time{20};

/// PAL digital video, a 4:3 chip and blank borders at the sides.
wire::CameraConstants base_constants() {
  wire::CameraConstants k;
  k.image_width = 720;
  k.image_height = 576;
  k.blank_left = k.blank_right = 10;
  k.chip_width = 6.4;
  k.chip_height = 4.8;
  return k;
}

/// Where each parameter rests and how far it swings to both sides.
struct Swing {
  double rest, amplitude;
};

camera::Camera test_camera(unsigned index) {
  const wire::CameraConstants k = base_constants();
  // Metres, degrees (the field of view is horizontal), millimetres.
  const Swing swings[test_parameters] = {
      {0, 3}, {-2, 5}, {1.5, 1}, {0, 90}, {0, 45}, {0, 60}, {45, 40}, {0, k.chip_width / 4}, {0, k.chip_height / 4}};
  const double phase = 2 * pi * (index % sets_per_parameter) / (sets_per_parameter - 1);
  double now[test_parameters];
  for (unsigned i = 0; i < test_parameters; ++i) now[i] = swings[i].rest;
  now[index / sets_per_parameter] += swings[index / sets_per_parameter].amplitude * std::sin(phase);

  camera::Camera camera;
  camera.pose.translation() << now[0], now[1], now[2];
  camera.pose.linear() = camera::rotation_of({now[3], now[4], now[5]});
  camera.lens.image_distance = k.chip_width / 2 / std::tan(now[6] / 2 * pi / 180);
  camera.lens.center_shift = {now[7], now[8]};
  return camera;
}

}  // namespace

const char* const format_words_help =
    "Format words: matrix euler, camera_to_studio studio_to_camera, camera_z_up camera_y_up, studio_z_up studio_y_up,\n"
    "image_distance field_of_view, horizontal vertical diagonal, consider_blank ignore_blank, adjust_aspect "
    "keep_aspect,\n"
    "shift_on_chip shift_in_pixels. The first of each group is the default.";

unsigned format_from_arguments(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += word + ' ';
  const auto format = wire::format_from_words(all);
  if (!format) throw CLI::ValidationError(format.error());
  if (const auto sound = wire::check_writable(*format); !sound) throw CLI::ValidationError(sound.error());
  return *format;
}

trkCameraConstants test_constants(unsigned format) {
  return c_api::to_c(camera::constants_for(base_constants(), format));
}

trkCameraParams test_params(unsigned index, unsigned format) {
  const wire::CameraConstants constants = camera::constants_for(base_constants(), format);
  auto params = camera::encode(test_camera(index), format, &constants);
  if (!params) throw std::runtime_error("the test camera in this format: " + camera::describe(params.error()));
  params->counter = index + 1;
  return c_api::to_c(*params);
}

cli::ExitCode write_motion(const Writer& writer, unsigned format) {
  const cli::StopSignals signals;
  const auto is_written = [](trkError error) {
    if (error != trkOK) std::cerr << "writing: " << trkErrorMessage(error) << '\n';
    return error == trkOK;
  };
  const trkCameraConstants constants = test_constants(format);
  if (!is_written(writer.constants(&constants))) return cli::exit_failed;
  Pacing pacing{field_time};
  for (unsigned i = 0; i < test_sets; ++i) {
    const trkCameraParams params = test_params(i, format);
    if (!is_written(writer.params(&params))) return cli::exit_failed;
    if (!pacing.wait()) return cli::exit_good;
  }
  return cli::exit_good;
}

}  // namespace trk_bridge::programs
