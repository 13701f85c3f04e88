// What the programs write_mem, write_net and write_file share: the motion that tests one parameter after another.
#pragma once

#include <trk/trk_struct.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "cli/exit_code.h"

namespace trk_bridge::programs {

/// x, y, z, pan, tilt, roll, field of view, center shift in x and in y, each swinging once about its rest.
inline constexpr unsigned test_parameters = 9;
inline constexpr unsigned sets_per_parameter = 251;
inline constexpr unsigned test_sets = test_parameters * sets_per_parameter;

/// The mask that the words of the command line name. Throws CLI::ValidationError for one that is no format word, or a
/// mask that records must not have.
unsigned format_from_arguments(const std::vector<std::string>& words);

/// Constants whose fake chip agrees with `format`'s aspect option.
trkCameraConstants test_constants(unsigned format);
/// Set `index` of the motion, below test_sets, in `format`; its counter is `index` + 1.
trkCameraParams test_params(unsigned index, unsigned format);

/// The writing functions of one open handle.
struct Writer {
  std::function<trkError(const trkCameraConstants*)> constants;
  std::function<trkError(const trkCameraParams*)> params;
};

/// Writes constants and the whole motion at 50 sets a second, or until a signal.
cli::ExitCode write_motion(const Writer&, unsigned format);

/// For the help of the three programs.
extern const char* const format_words_help;

}  // namespace trk_bridge::programs
