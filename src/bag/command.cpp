// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "command.h"

#include <cstdint>
#include <fstream>
#include <iostream>
#include <limits>
#include <string_view>

#include <unistd.h>

#include "base/time_text.h"
#include "cli/arguments.h"
#include "cli/stop_signals.h"
#include "ros/trk_to_ros_parameters.h"

namespace trk_bridge::bag {
namespace {

constexpr const char* bag_help =
    "The bag holds what trk_to_ros would publish for a take, on /NAME/params, /NAME/constants, /NAME/camera_info, /tf "
    "and /tf_static. Without --date or --start its date is 1970-01-02, because a take does not contain its day. The "
    "take holds one set of parameters for every message of /NAME/params, or for every camera_info with a pose in tf; "
    "its time code is that of the first stamp in UTC. A bag that was truncated by a crash is converted as far as it "
    "goes.";

bool ends_in(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

bool is_named_bag(std::string_view path) { return ends_in(path, ".bag") || ends_in(path, ".bag.active"); }

bool begins_as_bag(const std::string& path) {
  std::string begin(7, '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == "#ROSBAG";
}

template <typename T>
T value_of(const tl::expected<T, std::string>& parsed, const char* option) {
  if (!parsed) throw CLI::ValidationError(std::string(option) + ": " + parsed.error());
  return *parsed;
}

}  // namespace

Command::Command(CLI::App& app) : command_(app.add_subcommand("bag", "Convert a take to a bag, or a bag to a take")) {
  command_->footer(bag_help);
  command_->add_option("FROM", from_, "TAKE.trk or TAKE.bag")->required();
  command_->add_option("TO", to_, "The result: TAKE.bag or TAKE.trk")->required();
  command_->add_flag("--overwrite", overwrite_, "Replace TO if it exists");
  command_
      ->add_option("--camera", camera_,
                   "Name of the camera in the bag (default: camera for a bag; the only one for a take)")
      ->type_name("NAME");
  command_
      ->add_option("--field-rate", field_rate_,
                   "Video fields a second (default: 50; for a take: as trk bag recorded it, else 50)")
      ->check(cli::number(ros1::field_rate_range.least, ros1::field_rate_range.most))
      ->type_name("HZ");
  command_
      ->add_option("--format", format_,
                   "Format words, in quotes, of the params in the bag or the take (default: as_received; tf "
                   "becomes euler)")
      ->type_name("WORDS");
  command_->add_option("--studio-frame", studio_frame_, "Default: studio")->type_name("FRAME");
  command_
      ->add_option(
          "--camera-frame", camera_frame_,
          "Frame of the camera axes (default: NAME for a bag; for a take the frame of camera_info, which is optical)")
      ->type_name("FRAME");
  add_options_to_bag();
  add_options_to_take();
}

void Command::add_options_to_bag() {
  auto* start =
      command_->add_option("--start", start_, "Time of the first field, instead of its time code")->type_name("TIME");
  auto* date = command_->add_option("--date", date_, "The day of the time code, in UTC")->type_name("YYYY-MM-DD");
  start->excludes(date);
  auto* optical = command_->add_option("--optical-frame", optical_frame_, "Default: NAME_optical")->type_name("FRAME");
  auto* compression = command_->add_option("--compression", compression_, "Of the bag (default: none)")
                          ->check(CLI::IsMember({"none", "bz2", "lz4"}));
  to_bag_only_ = {start, date, optical, compression};
}

void Command::add_options_to_take() {
  auto* input =
      command_->add_option("--input", input_, "params, or tf and camera_info (default: params if the bag has them)")
          ->check(CLI::IsMember({"params", "tf"}));
  auto* id = command_->add_option("--id", to_take_options_.id, "Camera id that replaces the one in the bag")
                 ->check(cli::whole_number(0, std::numeric_limits<std::uint32_t>::max()))
                 ->type_name("N");
  auto* width = command_->add_option("--chip-width", to_take_options_.chip_width, "For a bag without constants")
                    ->check(cli::positive_number())
                    ->type_name("MM");
  auto* height = command_->add_option("--chip-height", to_take_options_.chip_height, "For a bag without constants")
                     ->check(cli::positive_number())
                     ->type_name("MM");
  auto* optical = command_->add_flag("--camera-frame-is-optical", to_take_options_.camera_frame_is_optical,
                                     "The axes of --camera-frame are optical");
  to_take_only_ = {input, id, width, height, optical};
}

void Command::refuse_options_of(const std::vector<CLI::Option*>& options, const char* what) const {
  for (const auto* option : options) {
    if (option->count() > 0) throw CLI::ValidationError(option->get_name() + " is only for converting " + what);
  }
}

cli::ExitCode Command::run() {
  const cli::StopSignals signals;
  cli::LongRun run(std::cerr, ::isatty(STDERR_FILENO) == 1);
  const bool from_bag = is_named_bag(from_) || begins_as_bag(from_);
  if (from_bag == is_named_bag(to_)) {
    throw CLI::ValidationError(from_bag
                                   ? "both " + from_ + " and " + to_ + " are bags: TO must be a take"
                                   : to_ + ": the name of a bag ends in .bag, and " + from_ + " is not a bag either");
  }
  return from_bag ? to_take(run) : to_bag(run);
}

cli::ExitCode Command::to_bag(cli::LongRun& run) {
  refuse_options_of(to_take_only_, "a bag to a take");
  TakeToBagOptions options;
  if (camera_) options.camera = *camera_;
  if (format_) options.format = value_of(ros1::parse_published_format(*format_), "--format");
  if (studio_frame_) options.studio_frame = *studio_frame_;
  options.camera_frame = camera_frame_;
  options.optical_frame = optical_frame_;
  if (field_rate_) options.field_rate = *field_rate_;
  if (date_) options.midnight = value_of(base::parse_date(*date_), "--date");
  if (start_) options.start = value_of(base::parse_moment(*start_), "--start");
  options.compression = compression_;
  options.overwrite = overwrite_;
  bag_of_take(from_, to_, options, run, std::cerr);
  return cli::exit_good;
}

cli::ExitCode Command::to_take(cli::LongRun& run) {
  refuse_options_of(to_bag_only_, "a take to a bag");
  if (to_take_options_.camera_frame_is_optical && !camera_frame_) {
    throw CLI::ValidationError("--camera-frame-is-optical: needs --camera-frame, whose axes it describes");
  }
  to_take_options_.camera = camera_;
  to_take_options_.camera_frame = camera_frame_;
  to_take_options_.field_rate = field_rate_;
  to_take_options_.overwrite = overwrite_;
  if (studio_frame_) to_take_options_.studio_frame = *studio_frame_;
  if (format_) to_take_options_.format = value_of(ros1::parse_published_format(*format_), "--format");
  if (input_) to_take_options_.input = *input_ == "tf" ? Input::tf : Input::params;
  take_of_bag(from_, to_, to_take_options_, run, std::cerr);
  return cli::exit_good;
}

}  // namespace trk_bridge::bag
