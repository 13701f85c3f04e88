// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "delay_command.h"

#include <iostream>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>
#include <unistd.h>

#include "cameras.h"
#include "cli/arguments.h"
#include "cli/checked_output.h"
#include "cli/stop_signals.h"
#include "delay/plot.h"
#include "delay/report.h"
#include "fields.h"
#include "ros/trk_to_ros_parameters.h"

namespace trk_bridge::bag {
namespace {

constexpr const char* delay_help =
    "The bag has NAME/params and NAME/constants of trk_to_ros and the camera's video, stamped by one clock. The camera "
    "should stand still, pan quickly and stop, a few times. A positive delay means that the video is late: set delay:= "
    "of ros_to_trk. A negative one means that tracking is late: add its amount to delay:= of trk_to_ros.";

template <typename Message>
bool is_of_type(const Connection& connection) {
  return connection.type == ::ros::message_traits::datatype<Message>();
}

bool is_video(const Connection& connection) {
  return is_of_type<sensor_msgs::Image>(connection) || is_of_type<sensor_msgs::CompressedImage>(connection);
}

std::string choose_video(const std::vector<Connection>& connections, const std::string& camera,
                         const std::optional<std::string>& named) {
  if (named) {
    std::string topic = named->rfind('/', 0) == 0 ? *named : "/" + *named;
    for (const auto& connection : connections) {
      if (connection.topic == topic && !is_video(connection)) has_topic<sensor_msgs::Image>(connections, topic);
      if (connection.topic == topic) return topic;
    }
    throw BagError("no topic " + topic);
  }
  std::vector<std::string> all, own;
  for (const auto& connection : connections) {
    if (!is_video(connection)) continue;
    if (connection.topic == topic_of(camera, "image_raw")) return connection.topic;
    all.push_back(connection.topic);
    if (connection.topic.rfind(topic_of(camera, ""), 0) == 0) own.push_back(connection.topic);
  }
  const auto& fit = own.empty() ? all : own;
  if (fit.empty()) throw BagError("no topic of type sensor_msgs/Image or sensor_msgs/CompressedImage");
  if (fit.size() == 1) return fit.front();
  std::string listed;
  for (const auto& topic : fit) listed += (listed.empty() ? "" : ", ") + topic;
  throw BagError("several topics with pictures, --image must name one: " + listed);
}

template <typename Message>
std::int64_t checked_stamp(const RawMessage& raw, const Message& message) {
  const std::int64_t stamp = stamp_of(message);
  if (stamp == 0) throw BagError("a message of " + raw.connection.topic + " has no stamp");
  return stamp;
}

template <typename Message>
void add_frame(const RawMessage& raw, delay::Meter& meter) {
  const auto message = message_of<Message>(raw);
  const std::int64_t stamp = checked_stamp(raw, message);
  try {
    meter.add(stamp, cv_bridge::toCvCopy(message, "mono8")->image);
  } catch (const cv_bridge::Exception& error) {
    throw BagError("a message of " + raw.connection.topic + " is not a picture: " + error.what());
  } catch (const cv::Exception& error) {
    throw BagError("a message of " + raw.connection.topic + " is not a picture: " + error.what());
  }
}

void read_constants(Reader& bag, const std::string& topic, delay::Meter& meter) {
  if (!has_topic<trk_bridge::CameraConstants>(bag.connections(), topic)) {
    throw BagError("there is no message on " + topic + ": record them as well (they are latched)");
  }
  bool known = false;
  bag.read([&](const Connection& connection) { return connection.topic == topic; },
           [&](const RawMessage& raw) {
             const auto change = meter.use(ros1::from_msg(message_of<trk_bridge::CameraConstants>(raw)));
             if (change == camera::ConstantsChange::invalid) {
               throw BagError("constants of " + topic + " describe no picture");
             }
             if (std::exchange(known, true) && change == camera::ConstantsChange::changed) {
               throw BagError("constants of " + topic + " change: cut the bag there (rosbag filter)");
             }
           });
}

delay::Measurement measured(Reader& bag, const DelayOptions& options, std::ostream& err) {
  const std::string camera = choose_camera(bag.connections(), options.camera, Input::params).name;
  const std::string params = topic_of(camera, "params");
  const std::string video = choose_video(bag.connections(), camera, options.image);
  has_topic<trk_bridge::CameraParams>(bag.connections(), params);
  delay::Meter meter(options.most_delay);
  read_constants(bag, topic_of(camera, "constants"), meter);
  Omissions omissions;
  bag.read([&](const Connection& connection) { return connection.topic == params || connection.topic == video; },
           [&](const RawMessage& raw) {
             if (is_of_type<sensor_msgs::Image>(raw.connection)) return add_frame<sensor_msgs::Image>(raw, meter);
             if (is_video(raw.connection)) return add_frame<sensor_msgs::CompressedImage>(raw, meter);
             const auto message = message_of<trk_bridge::CameraParams>(raw);
             const std::int64_t stamp = checked_stamp(raw, message);
             const auto added = meter.add(stamp, ros1::from_msg(message));
             if (!added) omissions.add(camera::describe(added.error()), stamp);
           });
  omissions.report(err);
  return meter.measure();
}

}  // namespace

delay::Measurement measure_delay(const std::string& path, const DelayOptions& options, cli::LongRun& run,
                                 std::ostream& err) {
  try {
    Reader bag(path, run);
    auto measurement = measured(bag, options, err);
    run.end();
    if (!bag.damage().empty()) err << "trk: " << path << " is truncated: " << bag.damage() << '\n';
    return measurement;
  } catch (const BagError& error) {
    throw BagError(path + ": " + error.what());
  }
}

DelayCommand::DelayCommand(CLI::App& app)
    : command_(app.add_subcommand("delay", "Measure the delay between a camera's video and its tracking in a bag")) {
  command_->footer(delay_help);
  command_->add_option("BAG", bag_, "Recorded with params, constants and pictures of the camera")->required();
  command_->add_option("--camera", options_.camera, "Its name in the bag (default: the only one)")->type_name("NAME");
  command_->add_option("--image", options_.image, "Topic of its video (default: NAME/image_raw, or the only one)")
      ->type_name("TOPIC");
  command_->add_option("--field-rate", field_rate_, "Fields a second (default: the rate of params)")
      ->check(cli::number(ros1::field_rate_range.least, ros1::field_rate_range.most))
      ->type_name("HZ");
  command_->add_option("--most", options_.most_delay, "Search delays up to S seconds (default: 0.5)")
      ->check(cli::number(delay::min_search_range, delay::max_search_range))
      ->type_name("S");
  command_->add_option("--plot", plot_, "Plot both motions and their correlation")
      ->check(cli::is_svg)
      ->type_name("FILE.svg");
  command_->add_flag("--json", as_json_, "A JSON object");
}

cli::ExitCode DelayCommand::run() {
  const cli::StopSignals signals;
  cli::LongRun run(std::cerr, ::isatty(STDERR_FILENO) == 1);
  const auto measurement = measure_delay(bag_, options_, run, std::cerr);
  const double field = field_rate_ ? 1 / *field_rate_ : measurement.tracking_interval;
  const std::string summary = delay::summary(measurement, field);
  cli::CheckedOutput out(std::cout);
  if (as_json_) {
    out.line(delay::to_json(measurement, field), false);
  } else {
    out.line(summary, false);
    for (const auto& fault : delay::faults(measurement)) out.line(fault, false);
    for (const auto& [name, value] : delay::values(measurement, field)) out.line("  " + name + ": " + value, false);
    if (const std::string setting = delay::setting(measurement); !setting.empty()) out.line(setting, false);
  }
  if (plot_ && measurement.speeds.empty()) {
    std::cerr << "trk: " << *plot_ << " is not drawn: there is nothing to compare\n";
  } else if (plot_) {
    cli::write_whole_file(*plot_, delay::to_svg(measurement, summary));
  }
  const cli::ExitCode written = out.finish(std::cerr);
  return written != cli::exit_good || !measurement.cannot_tell ? written : cli::exit_failed;
}

}  // namespace trk_bridge::bag
