// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros_to_trk_parameters.h"

#include <cmath>
#include <set>
#include <utility>

#include "endpoints/presets.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::ros1 {
namespace {

void read_sinks(ParameterReader& node, const std::string& preset, std::vector<transport::SinkEndpoint>& sinks) {
  node.parsed_list("sinks", sinks, [&preset](const std::string& url) { return endpoints::parse_sink(url, preset); });
  if (!node.are_valid({"sinks"})) return;
  if (sinks.empty()) {
    node.fault("sinks", "[]", "must be given: endpoint URLs such as udp://host:7000, shm:7 or file:take.trk");
  }
  std::set<std::string> seen;
  for (const auto& sink : sinks) {
    if (!seen.insert(sink.url).second) node.fault("sinks", shown(sink.url), "is given twice");
  }
}

/// Returns the name of the preset; empty if there is none.
std::string read_form(ParameterReader& node, transport::SinkForm& form) {
  node.parsed("format", form.format, wire::format_from_words);
  std::optional<endpoints::Preset> preset;
  node.parsed("preset", preset, endpoints::find_preset);
  node.id("id", form.id);
  if (!preset) return {};
  if (node.has("format")) {
    if (node.are_valid({"format"})) {
      node.fault("preset", shown(preset->name), "must not be set together with format, because it sets the format");
    }
    return {};
  }
  form.format = preset->format;
  form.sends_id = preset->sends_id;
  return preset->name;
}

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

void read_delay(ParameterReader& node, transport::SinkForm& form) {
  double all = 0, lead = 0;
  if (node.is_map("delay")) {
    double position = 0, rotation = 0, lens = 0;
    auto parts = *node.map("delay");
    for (auto [key, into] : {std::pair{"position", &position}, {"rotation", &rotation}, {"lens", &lens}}) {
      if (!parts.has(key)) parts.fault(key, "(none)", "must be given: a delay has position, rotation and lens");
      parts.number(key, *into, sink_delay_range);
    }
    parts.refuse_unknown();
    form.delay = transport::Delay{nanoseconds(position), nanoseconds(rotation), nanoseconds(lens)};
  } else if (node.number("delay", all, sink_delay_range)) {
    form.delay = transport::Delay{nanoseconds(all), nanoseconds(all), nanoseconds(all)};
  }
  if (node.number("lead", lead, sink_lead_range)) {
    form.lead = nanoseconds(lead);
  }
}

void read_pace(ParameterReader& node, RosToTrkParameters& parameters) {
  const bool is_tf = parameters.input == OutgoingInput::tf;
  double rate = 50;
  if (node.is_text("rate")) {
    const std::string allowed = "must be 1 to 1000 Hz" + std::string(is_tf ? ", or tf" : "");
    bool is_that_of_tf = false;
    node.parsed("rate", is_that_of_tf, [&](const std::string& word) -> tl::expected<bool, std::string> {
      if (is_tf && word == "tf") return true;
      return tl::make_unexpected(allowed);
    });
  } else if (node.number("rate", rate, {1, 1000, "Hz"}) || is_tf) {
    parameters.rate = rate;
  }
  parameters.pace = is_tf && parameters.rate;
  node.flag("pace", parameters.pace);
}

void read_tf_input(ParameterReader& node, RosToTrkParameters& parameters) {
  auto& tf = parameters.tf;
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
  if (node.are_valid({"camera_frame", "studio_frame"}) && parameters.camera_frame == parameters.studio_frame) {
    node.fault("camera_frame", shown(parameters.camera_frame), "must differ from studio_frame");
  }
}

void check_input(ParameterReader& node, OutgoingInput input) {
  if (!node.are_valid({"input"})) return;
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
               "belongs to input params; with input tf the image size comes from camera_info: set chip_width, "
               "chip_height and blanks");
  }
}

}  // namespace

RosToTrkParameters read_ros_to_trk_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name) {
  ParameterReader node(tree);
  RosToTrkParameters parameters;
  parameters.name = parameters.camera_frame = camera_name;
  check_camera_name(camera_name, node);
  node.diagnostic_period();
  read_sinks(node, read_form(node, parameters.form), parameters.sinks);
  node.choice("input", parameters.input, {{"params", OutgoingInput::params}, {"tf", OutgoingInput::tf}});
  read_delay(node, parameters.form);
  read_pace(node, parameters);
  node.integer("queue_size", parameters.queue_size, {1, 100000});
  node.constants("constants", parameters.constants);
  read_tf_input(node, parameters);
  check_input(node, parameters.input);
  node.finish();
  return parameters;
}

}  // namespace trk_bridge::ros1
