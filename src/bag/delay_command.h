// `trk delay` as a subcommand.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/exit_code.h"
#include "cli/long_run.h"
#include "delay/meter.h"

namespace trk_bridge::bag {

struct DelayOptions {
  std::optional<std::string> camera;  ///< a namespace; none: the bag's only one
  std::optional<std::string> image;   ///< a topic; none: the camera's image_raw, or its only one, or the bag's only one
  double most_delay = 0.5;            ///< s
};

/// Measures the delay between a camera's params and constants and its video, sensor_msgs/Image or CompressedImage. What
/// is left out is reported on `err`. Throws BagError, whose text names the bag, and Interrupted.
delay::Measurement measure_delay(const std::string& bag, const DelayOptions&, cli::LongRun&, std::ostream& err);

class DelayCommand {
 public:
  explicit DelayCommand(CLI::App&);
  bool is_asked_for() const { return command_->parsed(); }
  /// Throws CLI::Error for wrong options, std::runtime_error for all else that goes wrong. exit_failed where the delay
  /// cannot be told.
  cli::ExitCode run();

 private:
  CLI::App* command_;
  std::string bag_;
  DelayOptions options_;
  std::optional<double> field_rate_;
  std::optional<std::string> plot_;
  bool as_json_ = false;
};

}  // namespace trk_bridge::bag
