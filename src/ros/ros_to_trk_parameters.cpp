#include "ros_to_trk_parameters.h"

#include <utility>

#include "shared_parameters.h"
#include "parameter_reader.h"

namespace trk_bridge::ros1 {
namespace {

void read_params_input(ParameterReader& node, RosToTrkParameters& parameters, std::vector<std::string>& faults) {
  parameters.constants = read_constants(node, faults);
  if (parameters.constants && parameters.input == "tf") {
    faults.push_back(node.path() +
                     "constants: belongs to input params; with input tf the picture is camera_info's, "
                     "give chip_width, chip_height and blanks");
  }
}

void read_tf_input(ParameterReader& node, RosToTrkParameters& parameters, std::vector<std::string>& faults) {
  take(node.number("rate"), parameters.rate);
  parameters.chip_width = node.number("chip_width");
  parameters.chip_height = node.number("chip_height");
  const std::pair<const char*, std::int32_t*> blanks[] = {{"blank_left", &parameters.blank_left},
                                                          {"blank_right", &parameters.blank_right},
                                                          {"blank_top", &parameters.blank_top},
                                                          {"blank_bottom", &parameters.blank_bottom}};
  for (const auto& [key, into] : blanks) {
    const auto blank = node.integer(key);
    if (blank && parameters.input == "params") {
      faults.push_back(node.path() + key + ": belongs to input tf; with input params the constants tell blanks");
    }
    take(blank, *into);
  }
  take(node.text("studio_frame"), parameters.studio_frame);
  parameters.camera_frame = node.text("camera_frame").value_or(parameters.name);
  take(node.flag("camera_frame_is_optical"), parameters.camera_frame_is_optical);
  take(node.number("focdist"), parameters.focdist);
  take(node.number("aperture"), parameters.aperture);
}

}  // namespace

RosToTrkParameters read_ros_to_trk_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name) {
  std::vector<std::string> faults;
  ParameterReader node(tree, "~", faults);
  check_diagnostic_period(node, faults);
  RosToTrkParameters parameters;
  parameters.name = camera_name;
  take(node.texts("sinks"), parameters.sinks);
  take(node.text("input"), parameters.input);
  parameters.format = node.text("format");
  parameters.preset = node.text("preset");
  parameters.id = read_id(node, faults);
  take(node.integer("queue_size"), parameters.queue_size);
  read_params_input(node, parameters, faults);
  read_tf_input(node, parameters, faults);
  node.refuse_unknown();
  // A value of the wrong type was left at its default: judging that as well would blame what nobody wrote.
  if (faults.empty()) faults = validate(parameters);
  if (!faults.empty()) throw ParameterError(faults);
  return parameters;
}

}  // namespace trk_bridge::ros1
