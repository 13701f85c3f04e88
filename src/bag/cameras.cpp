// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "cameras.h"

#include <iterator>
#include <map>
#include <string_view>

#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraParams.h>

namespace trk_bridge::bag {
namespace {

/// The namespace of a topic that ends in `last`.
std::optional<std::string> name_space_of(const std::string& topic, std::string_view last) {
  const std::size_t slash = topic.rfind('/');
  if (slash == std::string::npos || std::string_view(topic).substr(slash + 1) != last) return std::nullopt;
  const std::size_t begin = topic.front() == '/' ? 1 : 0;
  return slash < begin ? std::string() : topic.substr(begin, slash - begin);
}

struct CameraTopics {
  bool params = false, camera_info = false;
  bool can(Input input) const { return input == Input::params ? params : camera_info; }
};

/// By type only: the MD5 sum of the message is checked for the chosen camera only.
std::map<std::string, CameraTopics> cameras_in(const std::vector<Connection>& connections) {
  std::map<std::string, CameraTopics> cameras;
  for (const auto& connection : connections) {
    if (connection.type == ::ros::message_traits::datatype<trk_bridge::CameraParams>()) {
      if (const auto name = name_space_of(connection.topic, "params")) cameras[*name].params = true;
    }
    if (connection.type == ::ros::message_traits::datatype<sensor_msgs::CameraInfo>()) {
      if (const auto name = name_space_of(connection.topic, "camera_info")) cameras[*name].camera_info = true;
    }
  }
  return cameras;
}

std::string listed(const std::map<std::string, CameraTopics>& cameras) {
  std::string text;
  for (const auto& [name, topics] : cameras) {
    text += (text.empty() ? "" : ", ") + (name.empty() ? std::string("/") : name) +
            (topics.params && topics.camera_info ? " (params, camera_info)"
             : topics.params                     ? " (params)"
                                                 : " (camera_info)");
  }
  return text.empty() ? "no camera" : text;
}

const char* wanted(std::optional<Input> input) {
  if (!input) return "params of type trk_bridge/CameraParams or camera_info of type sensor_msgs/CameraInfo";
  return *input == Input::params ? "params of type trk_bridge/CameraParams"
                                 : "camera_info of type sensor_msgs/CameraInfo";
}

}  // namespace

std::string topic_of(const std::string& camera, const std::string& last) {
  return camera.empty() ? "/" + last : "/" + camera + "/" + last;
}

ChosenCamera choose_camera(const std::vector<Connection>& connections, const std::optional<std::string>& name,
                           std::optional<Input> input) {
  const auto all = cameras_in(connections);
  const std::string bare = name ? name->substr(!name->empty() && name->front() == '/' ? 1 : 0) : std::string();
  auto fit = all;
  for (auto camera = fit.begin(); camera != fit.end();) {
    const bool other_name = name && camera->first != bare;
    const bool other_input = input && !camera->second.can(*input);
    camera = other_name || other_input ? fit.erase(camera) : std::next(camera);
  }
  if (fit.empty() && name) {
    // Throws a more specific error if the topic exists with another type.
    has_topic<trk_bridge::CameraParams>(connections, topic_of(bare, "params"));
    has_topic<sensor_msgs::CameraInfo>(connections, topic_of(bare, "camera_info"));
    throw BagError("camera " + *name + " has no topic " + wanted(input) + "; the bag has " + listed(all));
  }
  if (fit.empty()) throw BagError(std::string("no topic ") + wanted(input) + "; the bag has " + listed(all));
  if (fit.size() > 1) throw BagError("several cameras, --camera must name one: " + listed(fit));
  const auto& [chosen, topics] = *fit.begin();
  return {chosen, input.value_or(topics.params ? Input::params : Input::tf)};
}

}  // namespace trk_bridge::bag
