#include "trk_to_ros_parameters.h"

#include <utility>

#include "shared_parameters.h"
#include "parameter_reader.h"

namespace trk_bridge::ros1 {
namespace {

using XmlRpc::XmlRpcValue;

/// What a camera has of its own or inherits from the node.
void read_shared(ParameterReader& reader, CameraParameters& camera, std::vector<std::string>& faults) {
  take(reader.text("source"), camera.source);
  take(reader.text("studio_frame"), camera.studio_frame);
  take(reader.text("format"), camera.format);
  take(reader.number("delay"), camera.delay);
  take(reader.flag("publish_tf"), camera.publish_tf);
  take(reader.flag("publish_camera_info"), camera.publish_camera_info);
  take(reader.flag("publish_markers"), camera.publish_markers);
  take(reader.number("marker_far"), camera.marker_far);
  if (auto constants = read_constants(reader, faults)) camera.constants = constants;
}

/// What only one camera can have.
void read_own(ParameterReader& reader, CameraParameters& camera, std::vector<std::string>& faults) {
  camera.id = read_id(reader, faults);
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
  check_diagnostic_period(node, faults);
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
