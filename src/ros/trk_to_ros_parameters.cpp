#include "trk_bridge/ros/trk_to_ros_parameters.h"

#include <utility>

#include "trk_bridge/ros/parameter_reader.h"

namespace trk_bridge::ros1 {
namespace {

using XmlRpc::XmlRpcValue;

template <typename T>
void take(std::optional<T> given, T& into) {
  if (given) into = *std::move(given);
}

std::optional<wire::CameraConstants> read_constants(ParameterReader& outer, std::vector<std::string>& faults) {
  const auto tree = outer.map("constants");
  if (!tree) return std::nullopt;
  ParameterReader reader(*tree, outer.path() + "constants/", faults);
  wire::CameraConstants constants;
  const std::pair<const char*, std::int32_t*> pixels[] = {
      {"image_width", &constants.image_width}, {"image_height", &constants.image_height},
      {"blank_left", &constants.blank_left},   {"blank_right", &constants.blank_right},
      {"blank_top", &constants.blank_top},     {"blank_bottom", &constants.blank_bottom}};
  for (const auto& [key, into] : pixels) take(reader.integer(key), *into);
  const std::pair<const char*, double*> millimetres[] = {{"chip_width", &constants.chip_width},
                                                         {"chip_height", &constants.chip_height},
                                                         {"fake_chip_width", &constants.fake_chip_width},
                                                         {"fake_chip_height", &constants.fake_chip_height}};
  for (const auto& [key, into] : millimetres) take(reader.number(key), *into);
  for (const char* key : {"image_width", "image_height", "chip_width", "chip_height"}) {
    if (!reader.has(key))
      faults.push_back(reader.path() + key + ": must be given (blanks and fake chip may be left out)");
  }
  reader.refuse_unknown();
  return constants;
}

/// What a camera has of its own or inherits from the node.
void read_shared(ParameterReader& reader, CameraParameters& camera, std::vector<std::string>& faults) {
  take(reader.text("source"), camera.source);
  take(reader.text("studio_frame"), camera.studio_frame);
  take(reader.text("format"), camera.format);
  take(reader.number("delay"), camera.delay);
  take(reader.flag("publish_tf"), camera.publish_tf);
  take(reader.flag("publish_camera_info"), camera.publish_camera_info);
  if (auto constants = read_constants(reader, faults)) camera.constants = constants;
}

/// What only one camera can have.
void read_own(ParameterReader& reader, CameraParameters& camera, std::vector<std::string>& faults) {
  if (const auto id = reader.integer("id")) {
    if (*id < 0) {
      faults.push_back(reader.path() + "id = " + std::to_string(*id) + ": must be 0 or more");
    } else {
      camera.id = static_cast<std::uint32_t>(*id);
    }
  }
  camera.camera_frame = reader.text("camera_frame").value_or(camera.name);
  camera.optical_frame = reader.text("optical_frame").value_or(camera.name + "_optical");
}

void read_cameras(ParameterReader& node, const CameraParameters& shared, TrkToRosParameters& parameters,
                  std::vector<std::string>& faults) {
  for (const char* key : {"id", "camera_frame", "optical_frame"}) {
    node.know(key);
    if (node.has(key)) faults.push_back(node.path() + key + ": with cameras, it belongs to each of them");
  }
  const auto tree = node.map("cameras");
  if (!tree) return;
  ParameterReader cameras(*tree, node.path() + "cameras/", faults);
  for (const auto& name : cameras.keys()) {
    const auto one = cameras.map(name);
    if (!one) continue;
    ParameterReader reader(*one, cameras.path() + name + "/", faults);
    CameraParameters camera = shared;
    camera.name = name;
    read_shared(reader, camera, faults);
    read_own(reader, camera, faults);
    reader.refuse_unknown();
    parameters.cameras.push_back(std::move(camera));
  }
}

}  // namespace

TrkToRosParameters read_trk_to_ros_parameters(const XmlRpcValue& tree, const std::string& camera_name) {
  std::vector<std::string> faults;
  ParameterReader node(tree, "~", faults);
  // diagnostic_updater's own: seconds between diagnostics.
  if (const auto period = node.number("diagnostic_period"); period && !(*period > 0)) {
    faults.push_back("~diagnostic_period = " + std::to_string(*period) + ": must be more than 0 seconds");
  }
  TrkToRosParameters parameters;
  take(node.number("field_rate"), parameters.field_rate);
  take(node.text("stamp"), parameters.stamp);
  take(node.integer("queue_size"), parameters.queue_size);
  CameraParameters camera;
  camera.name = camera_name;
  read_shared(node, camera, faults);
  parameters.several = node.has("cameras");
  if (parameters.several) {
    read_cameras(node, camera, parameters, faults);
  } else {
    node.know("cameras");
    read_own(node, camera, faults);
    parameters.cameras.push_back(std::move(camera));
  }
  node.refuse_unknown();
  // A value of the wrong type was left at its default: judging that as well would blame what nobody wrote.
  if (faults.empty()) faults = validate(parameters);
  if (!faults.empty()) throw ParameterError(faults);
  return parameters;
}

}  // namespace trk_bridge::ros1
