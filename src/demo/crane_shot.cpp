// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "crane_shot.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <ros/console.h>
#include <ros/init.h>

#include "crane_motion.h"
#include "mains.h"
#include "nodes/node.h"
#include "ros/parameter_reader.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::demo {
namespace {

using Clock = std::chrono::steady_clock;

struct Parameters {
  double rate = 50;          // Hz
  bool moves_joints = true;  // false: another node publishes joint states
  std::string optical_frame = "camera_optical";
};

Parameters read_crane_parameters(const XmlRpc::XmlRpcValue& tree) {
  ros1::ParameterReader reader(tree);
  Parameters parameters;
  reader.number("rate", parameters.rate, {1, 1000, "Hz"});
  reader.choice("joints", parameters.moves_joints, {{"shot", true}, {"external", false}});
  reader.parsed("optical_frame", parameters.optical_frame, ros1::parse_frame);
  reader.diagnostic_period();
  reader.finish();
  return parameters;
}

template <typename T>
T value_or_throw(camera::Result<T> result, const char* what) {
  if (!result) throw std::runtime_error(std::string(what) + ": " + camera::describe(result.error()));
  return *std::move(result);
}

}  // namespace

CraneShot::CraneShot(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name)
    : diagnostics_(node, private_node, name) {
  const auto parameters = nodes::read_parameters(private_node, read_crane_parameters);
  rate_ = parameters.rate;
  moves_joints_ = parameters.moves_joints;
  camera_info_.header.frame_id = parameters.optical_frame;
  joint_state_.name.assign(joint_names.begin(), joint_names.end());
  joint_state_.position.resize(joint_names.size());
  constexpr std::uint32_t queue = 100;
  if (moves_joints_) joint_states_ = node.advertise<sensor_msgs::JointState>("joint_states", queue);
  camera_infos_ = node.advertise<sensor_msgs::CameraInfo>("camera_info", queue);
  lenses_ = node.advertise<trk_bridge::CameraParams>("lens", queue);
  diagnostics_.start();
  thread_ = std::thread([this] { run(); });
}

CraneShot::~CraneShot() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  stop_.notify_one();
  thread_.join();
}

void CraneShot::run() {
  try {
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate_));
    const auto begin = Clock::now();
    auto next = begin;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!stop_.wait_until(lock, next, [this] { return stopped_; })) {
      const auto now = Clock::now();
      publish(std::chrono::duration<double>(now - begin).count());
      // Missed cycles are skipped.
      next += period * std::max<Clock::rep>(1, (now - next) / period);
    }
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("the crane stops: " << error.what());
    ::ros::shutdown();
  }
}

void CraneShot::publish(double seconds) {
  const Moment moment = moment_at(seconds);
  const auto constants = camera_constants();
  const auto stamp = ::ros::Time::now();

  camera_info_.header.stamp = stamp;
  ros1::to_msg(value_or_throw(calibrator_.calibrate(moment.lens, constants), "camera_info"), camera_info_);
  camera_infos_.publish(camera_info_);

  camera::Camera camera;
  camera.lens = moment.lens;
  lens_.header.stamp = stamp;
  ros1::to_msg(value_or_throw(camera::encode(camera, wire::euler, &constants), "lens"), lens_);
  lenses_.publish(lens_);

  if (!moves_joints_) return;
  joint_state_.header.stamp = stamp;
  std::copy(moment.joints.begin(), moment.joints.end(), joint_state_.position.begin());
  joint_states_.publish(joint_state_);
}

int crane_shot_main(int argc, char** argv) { return nodes::node_main<CraneShot>(argc, argv, "crane_shot"); }

}  // namespace trk_bridge::demo
