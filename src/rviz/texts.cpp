// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "texts.h"

#include <cmath>
#include <cstdio>

#include "samples.h"

namespace trk_bridge::rviz_display {
namespace {

template <typename... Numbers>
std::string print(const char* format, Numbers... numbers) {
  char text[160];
  const int length = std::snprintf(text, sizeof text, format, numbers...);
  return std::string(text, length < 0 ? 0 : std::min(static_cast<std::size_t>(length), sizeof text - 1));
}

/// Two decimals, and never "-0.00".
double rounded(double value) {
  const double result = std::round(value * 100) / 100;
  return result == 0 ? 0 : result;
}

void append(std::string& line, const std::string& word) {
  if (!line.empty()) line += "   ";
  line += word;
}

std::string lens_line(const Values& values) {
  std::string line;
  if (values.image_distance) {
    append(line, print("f %.2f mm", *values.image_distance));
  } else if (values.focal_length) {
    append(line, print("f %.0f px", *values.focal_length));
  }
  if (values.field_of_view) {
    append(line,
           print("fov %.1f\u00b0 x %.1f\u00b0", values.field_of_view->horizontal, values.field_of_view->vertical));
  }
  if (values.counter) append(line, "#" + std::to_string(*values.counter));
  return line;
}

}  // namespace

std::string text_of(const Values& values) {
  std::string text;
  if (values.pan_tilt_roll) {
    const auto& angles = *values.pan_tilt_roll;
    text = print("pan %.2f\u00b0   tilt %.2f\u00b0   roll %.2f\u00b0", rounded(angles.pan), rounded(angles.tilt),
                 rounded(angles.roll));
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
    return {age <= old_age, print("no stamp; %.2f s since arrival", rounded(age))};
  }
  const double age = seconds_between(stamp, now);
  if (age < -old_age) return {false, print("%.2f s: the stamp is in the future", rounded(age))};
  if (age > old_age) return {false, print("%.2f s: the stamp is older than %.0f s", rounded(age), old_age)};
  return {true, print("%.2f s", rounded(age))};
}

std::string silence_text(const std::string& topic, const ros::Time& last_arrival, const ros::Time& now) {
  return "no messages on " + topic + " for " + print("%.1f s", seconds_between(last_arrival, now)) + ", since " +
         print("%.3f", last_arrival.toSec());
}

}  // namespace trk_bridge::rviz_display
