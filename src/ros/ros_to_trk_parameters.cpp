#include "ros_to_trk_parameters.h"

#include <set>
#include <utility>

#include "endpoints/presets.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::ros1 {
namespace {

void read_sinks(ParameterReader& node, std::vector<transport::SinkEndpoint>& sinks) {
  node.parsed_list("sinks", sinks, endpoints::parse_sink);
  if (!node.are_sound({"sinks"})) return;
  if (sinks.empty()) {
    node.fault("sinks", "[]", "must be given: endpoint URLs such as udp://host:7000, shm:7 or file:take.trk");
  }
  std::set<std::string> seen;
  for (const auto& sink : sinks) {
    if (!seen.insert(sink.url).second) node.fault("sinks", shown(sink.url), "is given twice");
  }
}

void read_form(ParameterReader& node, transport::SinkForm& form) {
  node.parsed("format", form.format, wire::format_from_words);
  std::optional<endpoints::Preset> preset;
  node.parsed("preset", preset, endpoints::find_preset);
  node.id("id", form.id);
  if (!preset) return;
  if (node.has("format")) {
    if (node.are_sound({"format"})) {
      node.fault("preset", shown(preset->name), "must not be given with format, which it stands for");
    }
    return;
  }
  form.format = preset->format;
  form.sends_id = preset->sends_id;
}

void read_tf_input(ParameterReader& node, RosToTrkParameters& parameters) {
  auto& tf = parameters.tf;
  node.number("rate", parameters.rate, {1, 1000, "Hz"});
  node.number("chip_width", tf.chip.chip_width, more_than(0, "mm"));
  node.number("chip_height", tf.chip.chip_height, more_than(0, "mm"));
  node.integer("blank_left", tf.chip.blank_left, at_least(0, "pixels"));
  node.integer("blank_right", tf.chip.blank_right, at_least(0, "pixels"));
  node.integer("blank_top", tf.chip.blank_top, at_least(0, "pixels"));
  node.integer("blank_bottom", tf.chip.blank_bottom, at_least(0, "pixels"));
  node.parsed("studio_frame", parameters.studio_frame, parse_frame);
  node.parsed("camera_frame", parameters.camera_frame, parse_frame);
  bool is_optical = false;
  node.flag("camera_frame_is_optical", is_optical);
  if (is_optical) tf.frame_T_camera = camera_T_optical().inverse();
  node.number("focdist", tf.focdist, at_least(0, "metres"));
  node.number("aperture", tf.aperture, at_least(0));
  if (node.are_sound({"camera_frame", "studio_frame"}) && parameters.camera_frame == parameters.studio_frame) {
    node.fault("camera_frame", shown(parameters.camera_frame), "must differ from studio_frame");
  }
}

void check_input(ParameterReader& node, OutgoingInput input) {
  if (!node.are_sound({"input"})) return;
  if (input == OutgoingInput::params) {
    for (const char* key : {"blank_left", "blank_right", "blank_top", "blank_bottom"}) {
      if (node.has(key)) node.fault(key, "belongs to input tf; with input params the blanks are in the constants");
    }
    return;
  }
  for (const char* key : {"chip_width", "chip_height"}) {
    if (!node.has(key)) node.fault(key, "(none)", "must be given with input tf: the chip's size in mm");
  }
  if (node.has("constants")) {
    node.fault("constants",
               "belongs to input params; with input tf the picture is camera_info's, give chip_width, chip_height "
               "and blanks");
  }
}

}  // namespace

RosToTrkParameters read_ros_to_trk_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name) {
  ParameterReader node(tree);
  RosToTrkParameters parameters;
  parameters.name = parameters.camera_frame = camera_name;
  check_camera_name(camera_name, node);
  node.diagnostic_period();
  read_sinks(node, parameters.sinks);
  node.choice("input", parameters.input, {{"params", OutgoingInput::params}, {"tf", OutgoingInput::tf}});
  read_form(node, parameters.form);
  node.integer("queue_size", parameters.queue_size, {1, 100000});
  node.constants("constants", parameters.constants);
  read_tf_input(node, parameters);
  check_input(node, parameters.input);
  node.finish();
  return parameters;
}

}  // namespace trk_bridge::ros1
