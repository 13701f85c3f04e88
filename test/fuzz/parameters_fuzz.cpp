// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any tree of parameters for every node: what is read keeps its ranges, or every fault is a line of its own.
#include <cmath>
#include <sstream>
#include <string>

#include "fuzz.h"
#include "ros/delay_meter_parameters.h"
#include "ros/parameter_reader.h"
#include "ros/ros_to_trk_parameters.h"
#include "ros/trk_to_ros_parameters.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"

namespace {

using namespace trk_bridge;
using test::claim;
using test::Input;
using XmlRpc::XmlRpcValue;

const char* const keys[] = {"source",
                            "cameras",
                            "stamp",
                            "format",
                            "id",
                            "delay",
                            "lead",
                            "rate",
                            "field_rate",
                            "queue_size",
                            "sinks",
                            "input",
                            "preset",
                            "pace",
                            "constants",
                            "studio_frame",
                            "distortion",
                            "counter",
                            "failover",
                            "publish_tf",
                            "lens",
                            "camera_frame",
                            "optical_frame",
                            "publish_markers",
                            "publish_camera_info",
                            "marker_far",
                            "chip_width",
                            "chip_height",
                            "blank_left",
                            "blank_right",
                            "image_width",
                            "image_height",
                            "blank_top",
                            "blank_bottom",
                            "fake_chip_width",
                            "position",
                            "rotation",
                            "focdist",
                            "aperture",
                            "fake_chip_height",
                            "window",
                            "most_delay",
                            "left",
                            "right",
                            "diagnostic_period",
                            "image_transport",
                            "camera_frame_is_optical"};
const char* const words[] = {"udp://:7000",
                             "udp://127.0.0.1:7001?format=euler",
                             "freed://127.0.0.1:40000?lens=none",
                             "shm:7",
                             "file:take.trk",
                             "euler",
                             "as_received",
                             "arrival",
                             "counter",
                             "auto",
                             "tf",
                             "params",
                             "plumb_bob",
                             "brainstorm",
                             "strict",
                             "crane1_optical",
                             "4294967295"};

XmlRpcValue any_value(Input& input, int depth);

XmlRpcValue any_map(Input& input, int depth) {
  XmlRpcValue map;
  map.begin();  // a map even without entries
  for (std::size_t left = input.below(12); left > 0 && !input.is_empty(); --left) {
    const std::size_t which = input.number<std::uint8_t>();
    const std::string key = which < std::size(keys) ? keys[which] : std::string(input.bytes(which % 8));
    map[key] = any_value(input, depth + 1);
  }
  return map;
}

XmlRpcValue any_value(Input& input, int depth) {
  switch (input.below(8)) {
    case 0:
      return XmlRpcValue(input.flag());
    case 1:
      return XmlRpcValue(input.number<std::int32_t>());
    case 2:
      return XmlRpcValue(static_cast<int>(input.number<std::uint8_t>()));
    case 3:
      return XmlRpcValue(input.number<double>());
    case 4:
      return XmlRpcValue(words[input.below(std::size(words))]);
    case 5: {
      const std::string text(input.bytes(input.below(64)));
      // No lens table of elsewhere is read.
      return XmlRpcValue(text.find('/') != std::string::npos && text.find("lens") != std::string::npos ? "" : text);
    }
    case 6: {
      XmlRpcValue list;
      list.setSize(0);
      const auto size = static_cast<int>(depth < 3 ? input.below(4) : 0);
      for (int i = 0; i < size; ++i) list[i] = any_value(input, depth + 1);
      return list;
    }
    default:
      return depth < 3 ? any_map(input, depth) : XmlRpcValue();
  }
}

void claim_valid(const ros1::TrkToRosParameters& read) {
  claim(!read.cameras.empty(), "no cameras");
  claim(!read.field_rate || ros1::field_rate_range.contains(*read.field_rate), "a field rate out of its range");
  claim(read.queue_size >= 0, "a queue of less than nothing");
  for (const auto& camera : read.cameras) {
    claim(camera.source && camera.source->open, "a camera without a source");
    claim(ros1::check_camera_name(camera.name).has_value(), "a name that is none");
    claim(std::isfinite(camera.marker_far), "a distance that is not finite");
  }
}

void claim_valid(const ros1::RosToTrkParameters& read) {
  claim(!read.sinks.empty() && read.form.format && wire::is_writable(*read.form.format), "nothing to send to, or as");
  claim(!read.rate || (std::isfinite(*read.rate) && *read.rate > 0), "a rate that is none");
  claim(read.queue_size >= 0, "a queue of less than nothing");
  for (const auto& sink : read.sinks) claim(sink.open != nullptr, "a sink that cannot be opened");
  if (read.constants) claim(camera::check(*read.constants).has_value(), "constants of no picture");
}

void claim_valid(const ros1::DelayMeterParameters& read) {
  claim(std::isfinite(read.window) && read.window > 0 && std::isfinite(read.most_delay), "a time that is none");
  if (read.constants) claim(camera::check(*read.constants).has_value(), "constants of no picture");
}

/// The errors; empty if all is valid.
template <typename Read>
std::string errors_of(const Read& read, const XmlRpcValue& tree) {
  try {
    claim_valid(read(tree, "crane1"));
    return {};
  } catch (const ros1::ParameterError& error) {
    const std::string text = error.what();
    claim(!text.empty() && text.back() != '\n', "refused without a reason");
    const std::string more = error.with_remedy("/crane1/node").what();
    claim(more.compare(0, text.size(), text) == 0, "a remedy in place of the reasons");
    return text;
  }
}

template <typename Read>
void claim_read(const Read& read, const XmlRpcValue& tree) {
  const std::string errors = errors_of(read, tree);
  claim(errors == errors_of(read, tree), "other faults when it is read again");
  if (tree.getType() != XmlRpcValue::TypeStruct) return;
  // One more that nobody knows is one more fault.
  XmlRpcValue with_unknown = tree;
  with_unknown["no_such_parameter"] = 1;
  claim(errors_of(read, with_unknown).find("~no_such_parameter = 1: unknown parameter") != std::string::npos,
        "an unknown parameter was accepted");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const std::size_t node = input.below(3);
  const XmlRpcValue tree = input.below(16) == 0 ? any_value(input, 0) : any_map(input, 0);
  if (node == 0) claim_read(ros1::read_trk_to_ros_parameters, tree);
  if (node == 1) claim_read(ros1::read_ros_to_trk_parameters, tree);
  if (node == 2) claim_read(ros1::read_delay_meter_parameters, tree);
  return 0;
}
