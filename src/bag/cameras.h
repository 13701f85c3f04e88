// The cameras of a bag, and the choice of one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reader.h"

namespace trk_bridge::bag {

/// What a take is made from: a camera's params and constants, or tf and its camera_info.
enum class Input { params, tf };

/// A namespace without its first slash ("studio1/crane1"; "" for topics that have none).
struct ChosenCamera {
  std::string name;
  Input input = Input::params;
};

/// The topic of a camera: "/studio1/crane1/params".
std::string topic_of(const std::string& camera, const std::string& last);

/// The only camera, or the one named, with or without its first slash; read by its params where it has any, unless
/// `input` says otherwise. Throws BagError: none, several (listing them), a topic that has another type or an older
/// form of the message.
ChosenCamera choose_camera(const std::vector<Connection>&, const std::optional<std::string>& name,
                           std::optional<Input> input);

/// Throws BagError when a connection of this topic carries anything else. False when there is none.
template <typename Message>
bool has_topic(const std::vector<Connection>& connections, const std::string& topic) {
  bool found = false;
  for (const auto& connection : connections) {
    if (connection.topic != topic) continue;
    if (!carries<Message>(connection)) {
      const std::string wanted = ::ros::message_traits::datatype<Message>();
      throw BagError("topic " + topic +
                     (connection.type == wanted ? " has another form of " + wanted + " than this program knows"
                                                : " is of type " + connection.type + ", not " + wanted));
    }
    found = true;
  }
  return found;
}

}  // namespace trk_bridge::bag
