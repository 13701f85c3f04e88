// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
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
  std::optional<std::string> camera;  ///< a namespace; none: the only camera of the bag
  /// A topic; none: image_raw of the camera, or its only image topic, or the only one of the bag.
  std::optional<std::string> image;
  double most_delay = 0.5;  ///< s
};

/// Measures the delay between a camera's params and constants and its video, sensor_msgs/Image or CompressedImage.
/// Omissions are reported on `err`. Throws BagError, whose text names the bag, and Interrupted.
delay::Measurement measure_delay(const std::string& bag, const DelayOptions&, cli::LongRun&, std::ostream& err);

class DelayCommand {
 public:
  explicit DelayCommand(CLI::App&);
  bool is_asked_for() const { return command_->parsed(); }
  /// Throws CLI::Error for wrong options, std::runtime_error for other errors. exit_failed if the delay cannot be
  /// determined.
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
