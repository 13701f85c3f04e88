// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "texts.h"

#include <cmath>

#include "base/number_text.h"
#include "samples.h"

namespace trk_bridge::rviz_display {
namespace {

using base::fixed_text;

constexpr const char* degree = "\u00b0";

/// Two decimals, and never "-0.00".
std::string two_decimals(double value) {
  const double result = std::round(value * 100) / 100;
  return fixed_text(result == 0 ? 0 : result, 2);
}

void append(std::string& line, const std::string& word) {
  if (!line.empty()) line += "   ";
  line += word;
}

std::string lens_line(const Values& values) {
  std::string line;
  if (values.image_distance) {
    append(line, "f " + fixed_text(*values.image_distance, 2) + " mm");
  } else if (values.focal_length) {
    append(line, "f " + fixed_text(*values.focal_length, 0) + " px");
  }
  if (values.field_of_view) {
    append(line, "fov " + fixed_text(values.field_of_view->horizontal, 1) + degree + " x " +
                     fixed_text(values.field_of_view->vertical, 1) + degree);
  }
  if (values.counter) append(line, "#" + std::to_string(*values.counter));
  return line;
}

}  // namespace

std::string text_of(const Values& values) {
  std::string text;
  if (values.pan_tilt_roll) {
    const auto& angles = *values.pan_tilt_roll;
    append(text, "pan " + two_decimals(angles.pan) + degree);
    append(text, "tilt " + two_decimals(angles.tilt) + degree);
    append(text, "roll " + two_decimals(angles.roll) + degree);
  }
  const std::string lens = lens_line(values);
  if (!text.empty() && !lens.empty()) text += '\n';
  return text + lens;
}

std::string name_of_topic(const std::string& topic) {
  const auto end = topic.rfind('/');
  if (end == std::string::npos || end == 0) return topic.substr(end == 0 ? 1 : 0);
  const auto begin = topic.front() == '/' ? 1u : 0u;
  return topic.substr(begin, end - begin);
}

Age age_of(const ros::Time& stamp, const ros::Time& arrival, const ros::Time& now) {
  if (stamp.isZero()) {
    const double age = seconds_between(arrival, now);
    return {age <= old_age, "no stamp; " + two_decimals(age) + " s since arrival"};
  }
  const double age = seconds_between(stamp, now);
  if (age < -old_age) return {false, two_decimals(age) + " s: the stamp is in the future"};
  if (age > old_age) {
    return {false, two_decimals(age) + " s: the stamp is older than " + fixed_text(old_age, 0) + " s"};
  }
  return {true, two_decimals(age) + " s"};
}

std::string silence_text(const std::string& topic, const ros::Time& last_arrival, const ros::Time& now) {
  return "no messages on " + topic + " for " + fixed_text(seconds_between(last_arrival, now), 1) + " s, since " +
         fixed_text(last_arrival.toSec(), 3);
}

}  // namespace trk_bridge::rviz_display
