// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The properties of the display, as in its panel and in the configuration file.
#pragma once

#include <string>

#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>

#include "camera_figure.h"

namespace trk_bridge::rviz_display {

/// Which values are shown.
struct ValuesShown {
  bool pan_tilt_roll = true, focal_length = true, field_of_view = true, counter = true;
};

/// The properties are children of the display and exist as long as it does.
class DisplayProperties {
 public:
  /// Slots of `display`, made with SLOT().
  struct Slots {
    const char* info_topic;
    const char* params_topic;
    const char* style;
  };
  DisplayProperties(rviz::Property* display, const Slots& slots);

  rviz::RosTopicProperty* info_topic() const { return info_topic_; }
  rviz::RosTopicProperty* params_topic() const { return params_topic_; }
  /// Seconds; 0: never.
  double timeout() const;
  /// The name to be shown; empty: that of the topic.
  std::string name() const { return name_.text->getStdString(); }
  ValuesShown values_shown() const;
  FigureStyle style() const;

 private:
  void add_frustum(rviz::Property* display, const char* changed);
  void add_planes(rviz::Property* display, const char* changed);
  void add_axis_and_body(rviz::Property* display, const char* changed);
  void add_texts(rviz::Property* display, const char* changed);
  void add_trail(rviz::Property* display, const char* changed);

  rviz::RosTopicProperty* info_topic_;
  rviz::RosTopicProperty* params_topic_;
  rviz::FloatProperty* timeout_;
  struct {
    rviz::BoolProperty* on;
    rviz::ColorProperty* colour;
    rviz::FloatProperty *alpha, *near, *far, *line_width;
  } frustum_{};
  struct {
    rviz::BoolProperty* on;
    rviz::ColorProperty* colour;
    rviz::FloatProperty *alpha, *distance;
    rviz::BoolProperty* undistorted;
  } image_plane_{};
  struct {
    rviz::BoolProperty* on;
    rviz::ColorProperty* colour;
    rviz::FloatProperty* alpha;
  } focus_plane_{};
  struct WithLength {
    rviz::BoolProperty* on;
    rviz::ColorProperty* colour;
    rviz::FloatProperty *alpha, *length;
  } axis_{}, body_{};
  struct {
    rviz::BoolProperty* on;
    rviz::StringProperty* text;
    rviz::ColorProperty* colour;
    rviz::FloatProperty* height;
  } name_{};
  struct {
    rviz::BoolProperty* on;
    rviz::ColorProperty* colour;
    rviz::FloatProperty* height;
    rviz::BoolProperty *pan_tilt_roll, *focal_length, *field_of_view, *counter;
  } values_{};
  struct {
    rviz::BoolProperty* on;
    rviz::ColorProperty* colour;
    rviz::FloatProperty *alpha, *length, *line_width;
  } trail_{};
};

}  // namespace trk_bridge::rviz_display
