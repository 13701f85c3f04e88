// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The cameras of a bag, and the choice of one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reader.h"

namespace trk_bridge::bag {

/// The source of a take: params and constants of a camera, or tf and its camera_info.
enum class Input { params, tf };

/// A namespace without leading slash ("studio1/crane1"; "" for topics without a namespace).
struct ChosenCamera {
  std::string name;
  Input input = Input::params;
};

/// The topic of a camera: "/studio1/crane1/params".
std::string topic_of(const std::string& camera, const std::string& last);

/// The only camera, or the named one, with or without leading slash. Its params are used if it has any, unless `input`
/// differs. Throws BagError if there is none or several (and lists them), or if a topic has another type or an older
/// definition of the message.
ChosenCamera choose_camera(const std::vector<Connection>&, const std::optional<std::string>& name,
                           std::optional<Input> input);

/// False if there is no such topic. Throws BagError if a connection of this topic has another message type.
template <typename Message>
bool has_topic(const std::vector<Connection>& connections, const std::string& topic) {
  bool found = false;
  for (const auto& connection : connections) {
    if (connection.topic != topic) continue;
    if (!carries<Message>(connection)) {
      const std::string wanted = ::ros::message_traits::datatype<Message>();
      throw BagError("topic " + topic +
                     (connection.type == wanted ? " has another definition of " + wanted + " than this program"
                                                : " is of type " + connection.type + ", not " + wanted));
    }
    found = true;
  }
  return found;
}

}  // namespace trk_bridge::bag
