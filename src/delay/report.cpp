// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <cmath>

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include "base/number_text.h"

namespace trk_bridge::delay {
namespace {

using base::fixed_text;

constexpr double least_fault = 0.01;      // of a focal length
constexpr double least_roll_fault = 0.1;  // of a scale: a person in front of the camera can cause a few percent
constexpr double sure = 3;                // standard deviations
constexpr double ms = 1e3;                // in a second

bool is_off(double scale, double error, double least) {
  return std::abs(scale - 1) > least && std::abs(scale - 1) > sure * error;
}

std::string with_error(double scale, double error) { return fixed_text(scale, 3) + " +- " + fixed_text(error, 3); }

bool has_focal_length(const Measurement& measurement) { return measurement.focal_length_scale.has_value(); }

bool is_focal_length_off(const Measurement& measurement) {
  return has_focal_length(measurement) &&
         is_off(*measurement.focal_length_scale, measurement.focal_length_error, least_fault);
}

std::string percent_wrong(double scale, const char* more, const char* less) {
  const double wrong = 1 / scale - 1;
  return fixed_text(std::abs(wrong) * 100, 1) + " % too " + (wrong > 0 ? more : less);
}

using Writer = rapidjson::Writer<rapidjson::StringBuffer>;

void write(Writer& json, const char* key, double value) {
  json.Key(key);
  if (std::isfinite(value)) {
    json.Double(value);
  } else {
    json.Null();
  }
}

void write(Writer& json, const Measurement& measurement, double field) {
  write(json, "delay", measurement.delay);
  write(json, "accuracy", measurement.accuracy);
  write(json, "fields", measurement.delay / field);
  write(json, "correlation", measurement.correlation);
  json.Key("axes");
  json.StartObject();
  for (std::size_t i = 0; i < axis_names.size(); ++i) {
    const Axis& axis = measurement.axes[i];
    json.Key(axis_names[i]);
    if (!axis.moved) {
      json.Null();
      continue;
    }
    json.StartObject();
    write(json, "scale", axis.scale);
    write(json, "scale_error", axis.scale_error);
    write(json, "correlation", axis.correlation);
    json.EndObject();
  }
  json.EndObject();
  write(json, "focal_length_scale", measurement.focal_length_scale.value_or(std::nan("")));
  write(json, "focal_length_error", has_focal_length(measurement) ? measurement.focal_length_error : std::nan(""));
}

}  // namespace

std::string summary(const Measurement& measurement, double field) {
  if (measurement.cannot_tell) return std::string("cannot tell: ") + describe(*measurement.cannot_tell);
  const double delay = measurement.delay;
  const std::string size = fixed_text(std::abs(delay) * ms, 1) + " ms ";
  const std::string fields = " (" + fixed_text(std::abs(delay) / field, 2) + " fields)";
  return (delay < 0 ? "tracking is " + size + "later than the video" : "the video is " + size + "later than tracking") +
         fields;
}

std::vector<std::string> faults(const Measurement& measurement) {
  std::vector<std::string> found;
  if (measurement.cannot_tell) return found;
  for (std::size_t i = 0; i < axis_names.size(); ++i) {
    const Axis& axis = measurement.axes[i];
    if (axis.moved && axis.scale < 0) found.push_back(std::string(axis_names[i]) + " turns the wrong way");
  }
  const Axis& roll = measurement.axes[2];
  if (roll.moved && roll.scale > 0 && is_off(roll.scale, roll.scale_error, least_roll_fault)) {
    found.push_back("tracking's roll is " + percent_wrong(roll.scale, "large", "small"));
  }
  if (is_focal_length_off(measurement)) {
    found.push_back("tracking's focal length is " + percent_wrong(*measurement.focal_length_scale, "long", "short"));
  }
  return found;
}

std::vector<std::pair<std::string, std::string>> values(const Measurement& measurement, double field) {
  std::vector<std::pair<std::string, std::string>> all;
  const auto rate = [](double interval) { return interval > 0 ? fixed_text(1 / interval, 2) : "unknown"; };
  if (!measurement.cannot_tell) {
    all.emplace_back("delay (ms)", fixed_text(measurement.delay * ms, 2));
    all.emplace_back("accuracy (ms)", fixed_text(measurement.accuracy * ms, 2));
    all.emplace_back("delay (fields)", fixed_text(measurement.delay / field, 3));
    all.emplace_back("field (ms)", fixed_text(field * ms, 2));
    all.emplace_back("correlation", fixed_text(measurement.correlation, 4));
    for (std::size_t i = 0; i < axis_names.size(); ++i) {
      const Axis& axis = measurement.axes[i];
      all.emplace_back(std::string(axis_names[i]) + " scale",
                       axis.moved ? with_error(axis.scale, axis.scale_error) : "hardly moved");
    }
    all.emplace_back("focal length scale", has_focal_length(measurement) ? with_error(*measurement.focal_length_scale,
                                                                                      measurement.focal_length_error)
                                                                         : "unknown");
  }
  all.emplace_back("video (Hz)", rate(measurement.frame_interval));
  all.emplace_back("tracking (Hz)", rate(measurement.tracking_interval));
  all.emplace_back("frames followed (%)", fixed_text(measurement.followed * 100, 0));
  return all;
}

std::string setting(const Measurement& measurement) {
  if (measurement.cannot_tell) return "";
  if (measurement.delay < 0) return "add to the delay of trk_to_ros: " + fixed_text(-measurement.delay, 4);
  return "for ros_to_trk: delay:=" + fixed_text(measurement.delay, 4);
}

std::string to_json(const Measurement& measurement, double field) {
  rapidjson::StringBuffer text;
  Writer json(text);
  json.StartObject();
  json.Key("cannot_tell");
  if (measurement.cannot_tell) {
    json.String(describe(*measurement.cannot_tell));
  } else {
    json.Null();
    write(json, measurement, field);
  }
  write(json, "field", field);
  write(json, "frame_interval", measurement.frame_interval);
  write(json, "tracking_interval", measurement.tracking_interval);
  write(json, "followed", measurement.followed);
  json.Key("faults");
  json.StartArray();
  for (const auto& fault : faults(measurement)) json.String(fault.c_str());
  json.EndArray();
  json.EndObject();
  return text.GetString();
}

}  // namespace trk_bridge::delay
