// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_to_ros_parameters.h"

#include <limits>
#include <utility>

#include "markers.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

constexpr const char* source_needed = "must be given: an endpoint URL such as udp://:7000, shm:7 or file:take.trk";

tl::expected<transport::SourceEndpoint, std::string> parse_source(const std::string& url) {
  if (url.empty()) return tl::make_unexpected(std::string(source_needed));
  return endpoints::parse_source(url);
}

/// A camera and the reader of its parameters, which knows which of them are valid.
struct Reading {
  CameraParameters camera;
  ParameterReader reader;
};

/// Parameters that a camera has itself or inherits from the node.
void read_shared(ParameterReader& reader, CameraParameters& camera) {
  auto& options = camera.options;
  reader.parsed("source", camera.source, parse_source);
  reader.parsed("studio_frame", camera.frames.studio, parse_frame);
  reader.parsed("format", options.format, parse_published_format);
  reader.choice("stamp", camera.stamp,
                {{"arrival", bridge::StampMode::arrival},
                 {"counter", bridge::StampMode::counter},
                 {"source", bridge::StampMode::source}});
  reader.number("delay", options.delay, stamp_delay_range);
  reader.choice("counter", options.counter,
                {{"auto", base::CounterUse::automatic},
                 {"strict", base::CounterUse::strict},
                 {"ignore", base::CounterUse::ignore}});
  reader.number("failover", options.failover, {0, 60, "seconds"});
  reader.constants("constants", options.constants);
  reader.flag("publish_tf", options.publish_tf);
  reader.flag("publish_camera_info", options.publish_camera_info);
  reader.choice("distortion", options.plumb_bob_tolerance,
                {{"auto", camera::plumb_bob_tolerance}, {"plumb_bob", std::numeric_limits<double>::infinity()}});
  reader.flag("publish_markers", camera.publish_markers);
  reader.number("marker_far", camera.marker_far, more_than(marker_near, "metres", 1000));
}

/// Parameters that belong to one camera only, and the rules between all its parameters.
void read_own(ParameterReader& reader, const std::string& name, CameraParameters& camera) {
  auto& frames = camera.frames;
  camera.name = name;
  check_camera_name(name, reader);
  const CameraFrames defaults = default_frames(name);
  frames.camera = defaults.camera;
  frames.optical = defaults.optical;
  reader.id("id", camera.options.id);
  reader.parsed("camera_frame", frames.camera, parse_frame);
  reader.parsed("optical_frame", frames.optical, parse_frame);

  const bool over_network = camera.source && camera.source->over_network;
  camera.options.stamp = camera.stamp.value_or(over_network ? bridge::StampMode::counter : bridge::StampMode::arrival);

  if (!camera.source && reader.are_valid({"source"})) reader.fault("source", "''", source_needed);
  constexpr const char* must_differ = "must differ from the camera's other frames";
  if (reader.are_valid({"camera_frame", "studio_frame"}) && frames.camera == frames.studio) {
    reader.fault("camera_frame", shown(frames.camera), must_differ);
  }
  if (reader.are_valid({"optical_frame", "camera_frame", "studio_frame"}) &&
      (frames.optical == frames.camera || frames.optical == frames.studio)) {
    reader.fault("optical_frame", shown(frames.optical), must_differ);
  }
  if (reader.are_valid({"publish_markers", "publish_camera_info"}) && camera.publish_markers &&
      !camera.options.publish_camera_info) {
    reader.fault("publish_markers", "true", "needs publish_camera_info, because its lens is drawn");
  }
}

/// A frame has only one parent in tf, so cameras cannot share a frame.
void check_frames_of_pair(Reading& one, const Reading& before) {
  const auto& frames = one.camera.frames;
  const auto& taken = before.camera.frames;
  const std::pair<const char*, const std::string&> own[] = {{"camera_frame", frames.camera},
                                                            {"optical_frame", frames.optical}};
  for (const auto& [key, frame] : own) {
    const bool clash = (before.reader.are_valid({"camera_frame"}) && frame == taken.camera) ||
                       (before.reader.are_valid({"optical_frame"}) && frame == taken.optical);
    if (one.reader.are_valid({key}) && clash) {
      one.reader.fault(key, shown(frame),
                       "is a frame of camera " + before.camera.name + ", too: a frame has one parent");
    }
  }
}

/// Checks that the records of cameras with the same source can be distinguished.
void check_ids_of_pair(Reading& one, Reading& before) {
  if (!one.reader.are_valid({"id"}) || !before.reader.are_valid({"id"})) return;
  const auto& id = one.camera.options.id;
  const auto& taken = before.camera.options.id;
  if (!id || !taken) {
    (id ? before : one)
        .reader.fault("id", "(none)",
                      "cameras " + before.camera.name + " and " + one.camera.name + " share " +
                          shown(one.camera.source->url) + ": each must have an id");
  } else if (id == taken) {
    one.reader.fault("id", std::to_string(*id),
                     "is camera " + before.camera.name + "'s, too: ids on one source must differ");
  }
}

void check_pair(Reading& one, Reading& before) {
  check_frames_of_pair(one, before);
  const auto& source = one.camera.source;
  const auto& other = before.camera.source;
  if (!one.reader.are_valid({"source"}) || !before.reader.are_valid({"source"}) || !source || !other) return;
  if (source->url == other->url) {
    check_ids_of_pair(one, before);
  } else if (source->place == other->place) {
    one.reader.fault("source", shown(source->url),
                     "camera " + before.camera.name + " reads the same port, slot or file as " + shown(other->url) +
                         ": cameras on one source must have exactly the same URL");
  }
}

std::vector<CameraParameters> read_cameras(ParameterReader& node, const CameraParameters& shared) {
  for (const char* key : {"id", "camera_frame", "optical_frame"}) {
    node.know(key);
    if (node.has(key)) node.fault(key, "belongs to each camera if cameras is set");
  }
  auto cameras = node.map("cameras");
  if (!cameras) return {};
  const auto names = cameras->keys();
  if (names.empty()) node.fault("cameras", "{}", "must have at least one camera");
  std::vector<Reading> all;
  for (const auto& name : names) {
    auto reader = cameras->map(name);
    if (!reader) continue;
    reader->inherit(node);
    Reading one{shared, *std::move(reader)};
    read_shared(one.reader, one.camera);
    read_own(one.reader, name, one.camera);
    for (auto& before : all) check_pair(one, before);
    one.reader.refuse_unknown();
    all.push_back(std::move(one));
  }
  std::vector<CameraParameters> read;
  for (auto& one : all) read.push_back(std::move(one.camera));
  return read;
}

}  // namespace

tl::expected<std::optional<std::uint32_t>, std::string> parse_published_format(const std::string& words) {
  if (words == as_received) return std::nullopt;
  const auto mask = wire::format_from_words(words);
  if (!mask) return tl::make_unexpected(mask.error() + "; or " + as_received);
  return *mask;
}

TrkToRosParameters read_trk_to_ros_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name) {
  ParameterReader node(tree);
  TrkToRosParameters parameters;
  node.diagnostic_period();
  double field_rate = 0;
  if (node.number("field_rate", field_rate, field_rate_range)) parameters.field_rate = field_rate;
  node.integer("queue_size", parameters.queue_size, {1, 100000});
  CameraParameters camera;
  read_shared(node, camera);
  parameters.several = node.has("cameras");
  if (parameters.several) {
    parameters.cameras = read_cameras(node, camera);
  } else {
    node.know("cameras");
    read_own(node, camera_name, camera);
    parameters.cameras.push_back(std::move(camera));
  }
  node.finish();
  return parameters;
}

}  // namespace trk_bridge::ros1
