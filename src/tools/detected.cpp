// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "detected.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include "monitor/text.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/camera/image.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::tools {
namespace {

using monitor::fixed;

// Plausible values of a camera in a studio.
constexpr double farthest = 200;               // m from the origin
constexpr double lowest = -0.5, highest = 30;  // m above the floor
constexpr double most_roll = 30, most_tilt = 60;
constexpr double narrowest = 0.3, widest = 140;  // degrees
// Smaller motion is noise of a camera at rest.
constexpr double least_way = 0.02, least_turn = 0.2;  // m, degrees

constexpr double full_turn = 360;

void extend(Motion::Range& range, double value) {
  range.least = std::min(range.least, value);
  range.most = std::max(range.most, value);
}

/// The equivalent angle nearest to `last`.
double unwrapped(double angle, double last) { return last + std::remainder(angle - last, full_turn); }

std::string text_of(const Motion::Range& range, int decimals) {
  const std::string least = fixed(range.least, decimals), most = fixed(range.most, decimals);
  return least == most ? least : least + " to " + most;
}

bool is_all(const Motion::Range& range, double value) { return range.least == value && range.most == value; }
/// Always beyond the limit, on one side.
bool stays_beyond(const Motion::Range& range, double limit) { return range.least > limit || range.most < -limit; }
double farther_end(const Motion::Range& range) { return std::max(std::abs(range.least), std::abs(range.most)); }

const wire::CameraConstants* constants_of(const Detected& found) {
  return found.camera.constants ? &*found.camera.constants : nullptr;
}

/// Degrees, horizontal, over the full chip; none without constants or without a lens.
std::optional<double> angle_of_view(const Detected& found) {
  const auto* constants = constants_of(found);
  if (constants == nullptr || !found.camera.latest->lens) return std::nullopt;
  const auto angle = camera::field_of_view(found.camera.latest->lens->image_distance, constants->chip_width);
  return angle ? std::optional(*angle) : std::nullopt;
}

std::string rate_text(const monitor::CameraState& camera) {
  std::string text = camera.rate ? fixed(*camera.rate, 2) + " Hz; " : "";
  text += std::to_string(camera.counts.accepted) + " records, ";
  return text + (camera.counts.lost == 0 ? "none" : std::to_string(camera.counts.lost)) + " lost";
}

std::string lens_text(const Detected& found) {
  const monitor::ParamsState& latest = *found.camera.latest;
  std::string text;
  if (latest.lens) {
    const auto angle = angle_of_view(found);
    text = angle ? "horizontal angle of view " + fixed(*angle, 2) + " degrees"
                 : "image distance " + fixed(latest.lens->image_distance, 3) + " mm";
    text += ", focus " + fixed(latest.lens->focdist, 2) + " m";
  } else {
    text = camera::describe(latest.lens.error());
  }
  const auto& encoders = latest.encoders;
  if (encoders.zoom) text += "; zoom encoder " + std::to_string(*encoders.zoom);
  if (encoders.focus) text += "; focus encoder " + std::to_string(*encoders.focus);
  if (const auto* c = constants_of(found)) {
    text += "; image " + std::to_string(c->image_width) + " x " + std::to_string(c->image_height) + " pixels, chip " +
            fixed(c->chip_width, 3) + " x " + fixed(c->chip_height, 3) + " mm";
  }
  return text;
}

bool has_moved(const Motion& motion) {
  return std::max({motion.x.size(), motion.y.size(), motion.z.size()}) > least_way ||
         std::max({motion.pan.size(), motion.tilt.size(), motion.roll.size()}) > least_turn;
}

void add_position_doubts(const Motion& motion, std::vector<std::string>& doubts) {
  if (is_all(motion.x, 0) && is_all(motion.y, 0) && is_all(motion.z, 0)) {
    doubts.emplace_back("the position is always 0 0 0: this tracker may report angles only");
    return;
  }
  const double far = std::max({farther_end(motion.x), farther_end(motion.y), farther_end(motion.z)});
  if (far > farthest) {
    doubts.push_back("the camera is " + fixed(far, 0) + " m from the origin: the numbers may be millimetres");
  } else if (motion.z.least < lowest || motion.z.most > highest) {
    doubts.push_back("the height is " + text_of(motion.z, 2) +
                     " m: the sender may use y or another axis for the height, or the opposite sign");
  }
}

void add_turn_doubts(const Motion& motion, std::vector<std::string>& doubts) {
  if (stays_beyond(motion.roll, most_roll)) {
    doubts.push_back("the camera is rolled by " + text_of(motion.roll, 1) +
                     " degrees all the time: its axes may differ from those of the format");
  }
  if (stays_beyond(motion.tilt, most_tilt)) {
    doubts.push_back("the camera is tilted by " + text_of(motion.tilt, 1) +
                     " degrees all the time: its axes may differ from those of the format");
  }
}

}  // namespace

void Motion::add(const Eigen::Isometry3d& pose) {
  const auto angles = camera::pan_tilt_roll(pose.linear());
  last_pan_ = unwrapped(angles.pan, last_pan_);
  last_roll_ = unwrapped(angles.roll, last_roll_);
  extend(x, pose.translation().x());
  extend(y, pose.translation().y());
  extend(z, pose.translation().z());
  extend(pan, last_pan_);
  extend(tilt, angles.tilt);
  extend(roll, last_roll_);
}

std::vector<std::string> doubts_of(const Detected& found) {
  std::vector<std::string> doubts;
  const monitor::ParamsState& latest = *found.camera.latest;
  if (!latest.pose) {
    doubts.push_back("no pose: " + camera::describe(latest.pose.error()));
  } else {
    add_position_doubts(found.motion, doubts);
    add_turn_doubts(found.motion, doubts);
  }
  if (const auto angle = angle_of_view(found); angle && (*angle < narrowest || *angle > widest)) {
    doubts.push_back("the horizontal angle of view is " + fixed(*angle, 2) +
                     " degrees: the lens or the chip may be in other units");
  }
  if (*latest.doubt != '\0') doubts.emplace_back(latest.doubt);
  if (!found.other_options.empty()) {
    doubts.push_back("this sender also sends records that only " + found.other_options + " accepts");
  }
  if (found.camera.counts.lost > 0) {
    doubts.push_back(std::to_string(found.camera.counts.lost) + " records were lost");
  }
  if (found.is_shared) {
    doubts.emplace_back("another sender sends the same id to this port: allow=ADDRESS selects one of them");
  }
  return doubts;
}

std::string launch_line(const Detected& found) {
  const std::string id = std::to_string(found.camera.key.id);
  return "roslaunch trk_bridge trk_to_ros.launch source:=\"" + found.source + "\" camera:=camera" + id +
         (found.needs_id ? " id:=" + id : "");
}

std::vector<std::string> lines_of(const Detected& found) {
  const monitor::ParamsState& latest = *found.camera.latest;
  const Motion& motion = found.motion;
  std::vector<std::string> lines{
      found.protocol + ", camera " + std::to_string(found.camera.key.id) + ", from " +
          transport::to_string(found.camera.key.sender) + " at " + found.place,
      "  rate      " + rate_text(found.camera),
      "  encoding  " + std::string(latest.origin) + "; format " + wire::format_to_words(latest.params.format),
  };
  if (latest.pose) {
    lines.push_back("  position  x " + text_of(motion.x, 2) + ", y " + text_of(motion.y, 2) + ", height " +
                    text_of(motion.z, 2) + " m");
    lines.push_back("  angles    pan " + text_of(motion.pan, 1) + ", tilt " + text_of(motion.tilt, 1) + ", roll " +
                    text_of(motion.roll, 1) + " degrees");
  }
  lines.push_back("  lens      " + lens_text(found));
  const auto doubts = doubts_of(found);
  for (const auto& doubt : doubts) lines.push_back("  doubtful  " + doubt);
  if (doubts.empty()) lines.emplace_back("  axes      plausible");
  lines.emplace_back(
      has_moved(motion)
          ? "  signs     right if pan to the left, tilt up and roll clockwise increased their numbers"
          : "  signs     nothing moved: repeat this while you pan to the left and tilt up; the numbers must increase");
  if (latest.lens && constants_of(found) == nullptr) {
    lines.emplace_back("  missing   constants: CameraInfo needs them as the node's parameter constants");
  }
  lines.push_back("  source    " + found.source);
  lines.push_back("  launch    " + launch_line(found));
  return lines;
}

std::string json_of(const Detected& found) {
  const monitor::ParamsState& latest = *found.camera.latest;
  rapidjson::StringBuffer text;
  rapidjson::Writer<rapidjson::StringBuffer> writer(text);
  const auto put = [&writer](const char* key, const std::string& value) {
    writer.Key(key);
    writer.String(value);
  };
  const auto put_count = [&writer](const char* key, std::uint64_t value) {
    writer.Key(key);
    writer.Uint64(value);
  };
  const auto put_number = [&writer](const char* key, std::optional<double> value) {
    writer.Key(key);
    if (value) {
      writer.Double(*value);
    } else {
      writer.Null();
    }
  };
  const auto put_range = [&writer](const char* key, const Motion::Range& range) {
    writer.Key(key);
    writer.StartArray();
    writer.Double(range.least);
    writer.Double(range.most);
    writer.EndArray();
  };
  writer.StartObject();
  put("protocol", found.protocol);
  put("place", found.place);
  put("sender", transport::to_string(found.camera.key.sender));
  put_count("id", found.camera.key.id);
  put("encoding", latest.origin);
  put("format_words", wire::format_to_words(latest.params.format));
  put_number("rate", found.camera.rate);
  put_count("records", found.camera.counts.accepted);
  put_count("lost", found.camera.counts.lost);
  if (latest.pose) {
    put_range("x", found.motion.x);
    put_range("y", found.motion.y);
    put_range("z", found.motion.z);
    put_range("pan", found.motion.pan);
    put_range("tilt", found.motion.tilt);
    put_range("roll", found.motion.roll);
  }
  put_number("angle_of_view", angle_of_view(found));
  writer.Key("has_constants");
  writer.Bool(constants_of(found) != nullptr);
  writer.Key("doubts");
  writer.StartArray();
  for (const auto& doubt : doubts_of(found)) writer.String(doubt);
  writer.EndArray();
  put("source", found.source);
  put("launch", launch_line(found));
  writer.EndObject();
  return text.GetString();
}

}  // namespace trk_bridge::tools
