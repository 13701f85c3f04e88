// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk bag` as a subcommand.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/exit_code.h"
#include "convert.h"

namespace trk_bridge::bag {

class Command {
 public:
  explicit Command(CLI::App&);
  bool is_asked_for() const { return command_->parsed(); }
  /// Throws CLI::Error for wrong options, std::runtime_error for other errors.
  cli::ExitCode run();

 private:
  void add_options_to_bag();
  void add_options_to_take();
  void refuse_options_of(const std::vector<CLI::Option*>&, const char* what) const;
  cli::ExitCode to_bag(cli::LongRun&);
  cli::ExitCode to_take(cli::LongRun&);

  CLI::App* command_;
  std::vector<CLI::Option*> to_bag_only_, to_take_only_;
  std::string from_, to_;
  bool overwrite_ = false;
  std::optional<std::string> camera_, format_, studio_frame_, camera_frame_;
  std::optional<double> field_rate_;
  // to a bag
  std::optional<std::string> start_, date_, optical_frame_;
  std::string compression_ = "none";
  // to a take
  std::optional<std::string> input_;
  BagToTakeOptions to_take_options_;
};

}  // namespace trk_bridge::bag
