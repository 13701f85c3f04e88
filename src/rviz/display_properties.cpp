// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "display_properties.h"

#include <cmath>

#include <ros/message_traits.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraParams.h>

namespace trk_bridge::rviz_display {
namespace {

/// Makes the properties of one group. Changes call a slot of the display.
class Group {
 public:
  Group(rviz::Property* display, const char* name, const char* description, const char* changed)
      : display_(display), changed_(changed), on_(flag(display, name, description)) {
    on_->setDisableChildrenIfFalse(true);
  }

  rviz::BoolProperty* on() const { return on_; }

  rviz::ColorProperty* colour(const QColor& standard, const char* description) const {
    return new rviz::ColorProperty("Color", standard, description, on_, changed_, display_);
  }
  rviz::FloatProperty* alpha(float standard, const char* description) const {
    return number("Alpha", standard, 0, 1, description);
  }
  rviz::FloatProperty* number(const char* name, float standard, float least, float most,
                              const char* description) const {
    auto* property = new rviz::FloatProperty(name, standard, description, on_, changed_, display_);
    property->setMin(least);
    property->setMax(most);
    return property;
  }
  rviz::FloatProperty* line_width(const char* description) const {
    return number("Line Width", 0.01f, 0.0001f, 1, description);
  }
  rviz::BoolProperty* flag(const char* name, const char* description) const { return flag(on_, name, description); }
  rviz::StringProperty* text(const char* name, const char* description) const {
    return new rviz::StringProperty(name, "", description, on_, changed_, display_);
  }

 private:
  rviz::BoolProperty* flag(rviz::Property* parent, const char* name, const char* description) const {
    return new rviz::BoolProperty(name, true, description, parent, changed_, display_);
  }

  rviz::Property* display_;
  const char* changed_;
  rviz::BoolProperty* on_;
};

constexpr float longest = 10000;    // m
constexpr float shortest = 0.001f;  // m

/// A configuration file may contain values that the editor refuses.
double value_of(rviz::FloatProperty* property) {
  const float value = property->getFloat();
  return std::isfinite(value) ? value : property->getMin();
}

Ogre::ColourValue colour_of(const rviz::ColorProperty* colour, rviz::FloatProperty* alpha) {
  auto result = colour->getOgreColor();
  result.a = static_cast<float>(value_of(alpha));
  return result;
}

}  // namespace

DisplayProperties::DisplayProperties(rviz::Property* display, const Slots& slots)
    : info_topic_(new rviz::RosTopicProperty(
          "Camera Info Topic", "", ros::message_traits::datatype<sensor_msgs::CameraInfo>(),
          "sensor_msgs/CameraInfo: lens and optical frame of the camera.", display, slots.info_topic, display)),
      params_topic_(new rviz::RosTopicProperty("Camera Params Topic", "",
                                               ros::message_traits::datatype<trk_bridge::CameraParams>(),
                                               "trk_bridge/CameraParams of the same camera: plane in focus, image "
                                               "distance, pan tilt roll and counter. Optional.",
                                               display, slots.params_topic, display)),
      timeout_(new rviz::FloatProperty("Timeout", 5,
                                       "Seconds of ROS time: nothing is drawn if there is no CameraInfo for this long. "
                                       "0: the last one is drawn as long as tf has its pose.",
                                       display, slots.style, display)) {
  timeout_->setMin(0);
  add_frustum(display, slots.style);
  add_planes(display, slots.style);
  add_axis_and_body(display, slots.style);
  add_texts(display, slots.style);
  add_trail(display, slots.style);
}

void DisplayProperties::add_frustum(rviz::Property* display, const char* changed) {
  const Group group(display, "Frustum",
                    "What the camera sees: the borders of its image at two depths with lens distortion, and the edges "
                    "through the corners.",
                    changed);
  frustum_ = {group.on(),
              group.colour({255, 170, 0}, "Of the lines."),
              group.alpha(1, "0: invisible, 1: opaque."),
              group.number("Near", 0.2f, shortest, longest, "Depth of the near border, m; less than Far."),
              group.number("Far", 3, shortest, longest, "Depth of the far border, m; more than Near."),
              group.line_width("m, of all lines except the trail.")};
}

void DisplayProperties::add_planes(rviz::Property* display, const char* changed) {
  const Group image(display, "Image Plane", "The border of the image with lens distortion at one depth, filled.",
                    changed);
  image_plane_ = {image.on(), image.colour({85, 200, 255}, "Of outlines and area."),
                  image.alpha(0.12f, "Of the area; the outlines are opaque. 0: invisible, 1: opaque."),
                  image.number("Distance", 1, shortest, longest, "Depth, m."),
                  image.flag("Undistorted", "Also the straight border of a pinhole camera with the same K, dashed.")};
  const Group focus(display, "Focus Plane",
                    "The plane in focus, at focdist of CameraParams; not drawn without it, nor beyond 1000 m.",
                    changed);
  focus_plane_ = {focus.on(), focus.colour({90, 220, 110}, "Of outline and area."),
                  focus.alpha(0.15f, "Of the area; the outline is opaque. 0: invisible, 1: opaque.")};
}

void DisplayProperties::add_axis_and_body(rviz::Property* display, const char* changed) {
  const Group axis(display, "Optical Axis", "From the optical centre forward.", changed);
  axis_ = {axis.on(), axis.colour({255, 80, 80}, "Of the line."), axis.alpha(0.8f, "0: invisible, 1: opaque."),
           axis.number("Length", 4, shortest, longest, "m.")};
  const Group body(display, "Body", "A camera whose lens ends in the optical centre, with a handle on top.", changed);
  body_ = {body.on(), body.colour({190, 190, 195}, "Of the body, shaded."), body.alpha(1, "0: invisible, 1: opaque."),
           body.number("Length", 0.4f, shortest, 100, "From the lens to the back, m.")};
}

void DisplayProperties::add_texts(rviz::Property* display, const char* changed) {
  // Not "Name": the configuration uses it for the name of the display.
  const Group name(display, "Camera Name", "WriteResult above the camera.", changed);
  name_ = {name.on(), name.text("Text", "Empty: the namespace of the CameraInfo topic."),
           name.colour({255, 255, 255}, "Of the letters."),
           name.number("Height", 0.18f, shortest, 100, "Of a capital letter, m.")};
  const Group values(display, "Values", "WriteResult below the camera.", changed);
  values_ = {values.on(),
             values.colour({220, 220, 220}, "Of the letters."),
             values.number("Height", 0.12f, shortest, 100, "Of a capital letter, m."),
             values.flag("Pan Tilt Roll",
                         "Degrees: from CameraParams in the studio, without them from tf in the fixed frame."),
             values.flag("Focal Length", "The image distance in mm if CameraParams contain it, else fx in pixels."),
             values.flag("Field of View", "Degrees, horizontal x vertical, through the centres of the image edges."),
             values.flag("Counter", "Of CameraParams.")};
}

void DisplayProperties::add_trail(rviz::Property* display, const char* changed) {
  const Group trail(display, "Trail", "The path of the optical centre.", changed);
  trail_ = {trail.on(), trail.colour({200, 120, 255}, "Of the line."), trail.alpha(1, "0: invisible, 1: opaque."),
            trail.number("Length", 5, 0, 600, "Seconds, by the stamps of CameraInfo; at most 4000 points."),
            trail.line_width("m.")};
}

double DisplayProperties::timeout() const { return value_of(timeout_); }

ValuesShown DisplayProperties::values_shown() const {
  return {values_.pan_tilt_roll->getBool(), values_.focal_length->getBool(), values_.field_of_view->getBool(),
          values_.counter->getBool()};
}

FigureStyle DisplayProperties::style() const {
  FigureStyle style;
  style.frustum = {frustum_.on->getBool(), colour_of(frustum_.colour, frustum_.alpha), value_of(frustum_.near),
                   value_of(frustum_.far)};
  style.line_width = value_of(frustum_.line_width);
  style.image_plane = {image_plane_.on->getBool(), colour_of(image_plane_.colour, image_plane_.alpha),
                       value_of(image_plane_.distance), image_plane_.undistorted->getBool()};
  style.focus_plane = {focus_plane_.on->getBool(), colour_of(focus_plane_.colour, focus_plane_.alpha)};
  style.axis = {axis_.on->getBool(), colour_of(axis_.colour, axis_.alpha), value_of(axis_.length)};
  style.body = {body_.on->getBool(), colour_of(body_.colour, body_.alpha), value_of(body_.length)};
  style.name = {name_.on->getBool(), name_.colour->getOgreColor(), value_of(name_.height)};
  style.values = {values_.on->getBool(), values_.colour->getOgreColor(), value_of(values_.height)};
  style.trail = {trail_.on->getBool(), colour_of(trail_.colour, trail_.alpha), value_of(trail_.length),
                 value_of(trail_.line_width)};
  return style;
}

}  // namespace trk_bridge::rviz_display
