#include <cmath>
#include <set>

#include "faults.h"
#include "camera_markers.h"
#include "trk_to_ros_parameters.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

void check_frames(const CameraParameters& camera, Faults& faults) {
  const std::pair<const char*, const std::string*> frames[] = {{"studio_frame", &camera.studio_frame},
                                                               {"camera_frame", &camera.camera_frame},
                                                               {"optical_frame", &camera.optical_frame}};
  std::set<std::string> seen;
  for (const auto& [key, frame] : frames) {
    if (check_frame(key, *frame, faults) && !seen.insert(*frame).second) {
      faults.add(key, quoted(*frame), "must differ from the camera's other frames");
    }
  }
}

void check_format(const CameraParameters& camera, Faults& faults) {
  if (camera.format == as_received) return;
  if (const auto mask = wire::format_from_words(camera.format); !mask) {
    faults.add("format", quoted(camera.format), mask.error() + "; or " + as_received);
  }
}

void check_markers(const CameraParameters& camera, Faults& faults) {
  constexpr double farthest = 1000;
  if (camera.publish_markers && !camera.publish_camera_info) {
    faults.add("publish_markers", "true", "needs publish_camera_info, whose lens is drawn");
  }
  if (!(camera.marker_far > marker_near && camera.marker_far <= farthest)) {
    faults.add("marker_far", std::to_string(camera.marker_far),
               "must be more than 0.2 (where the frustum begins) and at most 1000 metres");
  }
}

void check_camera(const CameraParameters& camera, Faults& faults) {
  check_name(camera.name, faults);
  if (camera.source.empty()) {
    faults.add("source", "''", "must be given: an endpoint URL such as udp://:7000, shm:7 or file:take.trk");
  } else if (const auto endpoint = endpoints::parse_source(camera.source); !endpoint) {
    faults.add("source", quoted(camera.source), endpoint.error());
  }
  check_frames(camera, faults);
  check_format(camera, faults);
  if (!std::isfinite(camera.delay) || camera.delay < 0 || camera.delay > 60) {
    faults.add("delay", std::to_string(camera.delay), "must be 0 to 60 seconds");
  }
  if (camera.constants) check_constants(*camera.constants, faults);
  check_markers(camera, faults);
}

/// Whether both name one UDP port that only one of them could bind.
bool same_port(const std::string& one, const std::string& other) {
  const auto a = endpoints::parse_source(one), b = endpoints::parse_source(other);
  return a && b && a->place == b->place && one.compare(0, 4, "udp:") == 0;
}

void check_pair(const CameraParameters& camera, const CameraParameters& before, Faults& faults) {
  if (camera.name == before.name) faults.add("name", quoted(camera.name), "two cameras cannot share a name");
  for (const auto* frame : {&camera.camera_frame, &camera.optical_frame}) {
    const char* key = frame == &camera.camera_frame ? "camera_frame" : "optical_frame";
    if (*frame == before.camera_frame || *frame == before.optical_frame) {
      faults.add(key, quoted(*frame), "is a frame of camera " + before.name + ", too: a frame has one parent");
    }
  }
  if (camera.source.empty() || before.source.empty()) return;
  if (camera.source != before.source) {
    if (same_port(camera.source, before.source)) {
      faults.add("source", quoted(camera.source),
                 "camera " + before.name + " has the same port as " + quoted(before.source) +
                     ": cameras on one port must give the very same URL");
    }
    return;
  }
  for (const auto* one : {&camera, &before}) {
    if (!one->id) {
      faults.add("id", "(none)",
                 "cameras " + before.name + " and " + camera.name + " share " + quoted(camera.source) +
                     ": each must say its id (camera " + one->name + " does not)");
      return;
    }
  }
  if (camera.id == before.id) {
    faults.add("id", std::to_string(*camera.id), "is camera " + before.name + "'s, too: ids on one source must differ");
  }
}

}  // namespace

std::vector<std::string> validate(const TrkToRosParameters& parameters) {
  Faults node("~");
  if (parameters.cameras.empty()) node.add("cameras", "{}", "must have at least one camera");
  if (!std::isfinite(parameters.field_rate) || parameters.field_rate < 1 || parameters.field_rate > 1000) {
    node.add("field_rate", std::to_string(parameters.field_rate), "must be 1 to 1000 Hz");
  }
  if (parameters.stamp == "counter") {
    node.add("stamp", "'counter'", "not available in this version; allowed is arrival");
  } else if (parameters.stamp != "arrival") {
    node.add("stamp", quoted(parameters.stamp), "must be arrival");
  }
  check_queue_size(parameters.queue_size, node);
  std::vector<std::string> lines = std::move(node.lines);
  for (auto camera = parameters.cameras.begin(); camera != parameters.cameras.end(); ++camera) {
    Faults faults(parameters.several ? "~cameras/" + camera->name + "/" : "~");
    check_camera(*camera, faults);
    for (auto before = parameters.cameras.begin(); before != camera; ++before) check_pair(*camera, *before, faults);
    lines.insert(lines.end(), faults.lines.begin(), faults.lines.end());
  }
  return lines;
}

}  // namespace trk_bridge::ros1
