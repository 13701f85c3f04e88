// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_to_ros.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include <visualization_msgs/MarkerArray.h>

#include "live_services.h"
#include "mains.h"
#include "node.h"
#include "ros/trk_to_ros_parameters.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::nodes {
namespace {

/// Queue size of a topic shared by `cameras` cameras.
std::uint32_t queue_for(std::ptrdiff_t cameras, const ros1::TrkToRosParameters& parameters) {
  return static_cast<std::uint32_t>(parameters.queue_size) * static_cast<std::uint32_t>(cameras);
}

/// One topic for all cameras with markers.
::ros::Publisher advertise_markers(::ros::NodeHandle& private_node, const ros1::TrkToRosParameters& parameters) {
  const auto count = std::count_if(parameters.cameras.begin(), parameters.cameras.end(),
                                   [](const auto& camera) { return camera.publish_markers; });
  if (count == 0) return {};
  return private_node.advertise<visualization_msgs::MarkerArray>("markers", queue_for(count, parameters));
}

}  // namespace

TrkToRos::TrkToRos(const ::ros::NodeHandle& node, ::ros::NodeHandle private_node, const std::string& name)
    : node_(node), diagnostics_(node_, private_node, name) {
  const auto parameters = read_parameters(private_node, [this](const auto& tree) {
    return ros1::read_trk_to_ros_parameters(tree, camera_name_of(node_.getNamespace()));
  });
  open(parameters, advertise_markers(private_node, parameters));
  send_static_transforms();
  for (const auto& camera : cameras_) {
    const std::string& of_several = camera->parameters().name;
    advertise_services(*camera, parameters.several ? ::ros::NodeHandle(private_node, of_several) : private_node);
  }
  diagnostics_.start();
  for (auto& reader : readers_) reader->start();
}

void TrkToRos::open(const ros1::TrkToRosParameters& parameters, const ::ros::Publisher& markers) {
  std::map<std::string, std::vector<CameraOutput*>> by_source;
  for (const auto& camera : parameters.cameras) {
    const auto topics = parameters.several ? ::ros::NodeHandle(node_, camera.name) : node_;
    cameras_.push_back(
        std::make_unique<CameraOutput>(topics, camera, parameters.field_rate, parameters.queue_size, markers));
    by_source[camera.source->url].push_back(cameras_.back().get());
  }
  const auto tf = node_.advertise<tf2_msgs::TFMessage>(
      "/tf", queue_for(static_cast<std::ptrdiff_t>(parameters.cameras.size()), parameters));
  const double field_rate = parameters.field_rate.value_or(bridge::assumed_field_rate);
  for (const auto& [url, cameras] : by_source) {
    const auto& endpoint = cameras.front()->parameters().source;
    readers_.push_back(std::make_unique<SourceReader>(endpoint->open(field_rate), cameras, tf));
    for (auto* camera : cameras) {
      diagnostics_.add(camera->parameters().name,
                       [camera, reader = readers_.back().get()] { return camera->describe(reader->report()); });
    }
  }
}

void TrkToRos::advertise_services(CameraOutput& camera, ::ros::NodeHandle node) {
  services_.push_back(advertise_seconds(node, "set_delay", ros1::stamp_delay_range, [&camera](double seconds) {
    auto live = camera.live();
    live.delay = seconds;
    camera.set(live);
    return Answer{true, "stamps of " + camera.parameters().name + " are " + ros1::shown(seconds) + " s earlier"};
  }));
  const auto add_switch = [&](const std::string& parameter, bool bridge::LiveOptions::*what) {
    services_.push_back(advertise_switch(node, "set_" + parameter, [&camera, parameter, what](bool on) {
      const bridge::LiveOptions& at_start = camera.parameters().options;
      if (!(at_start.*what)) {
        return Answer{false, parameter + " was false when the node started: it cannot be switched on later"};
      }
      auto live = camera.live();
      live.*what = on;
      camera.set(live);
      return Answer{true, parameter + " of " + camera.parameters().name + " is " + (on ? "on" : "off")};
    }));
  };
  add_switch("publish_tf", &bridge::LiveOptions::publish_tf);
  add_switch("publish_camera_info", &bridge::LiveOptions::publish_camera_info);
}

void TrkToRos::send_static_transforms() {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const auto& camera : cameras_) {
    if (!camera->parameters().options.publish_tf) continue;
    transforms.push_back(ros1::optical_transform(camera->parameters().frames, ::ros::Time::now()));
  }
  if (!transforms.empty()) static_transforms_.sendTransform(transforms);
}

int trk_to_ros_main(int argc, char** argv) { return node_main<TrkToRos>(argc, argv, "trk_to_ros"); }

}  // namespace trk_bridge::nodes
