// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_display.h"

#include <algorithm>
#include <chrono>

#include <ros/master.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/ogre_helpers/apply_visibility_bits.h>
#include <pluginlib/class_list_macros.hpp>

#include "camera_figure.h"
#include "fixed_frame.h"
#include "texts.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::rviz_display {
namespace {

rviz::StatusProperty::Level level_of(StatusLevel level) {
  switch (level) {
    case StatusLevel::ok:
      return rviz::StatusProperty::Ok;
    case StatusLevel::warn:
      return rviz::StatusProperty::Warn;
    case StatusLevel::error:
      break;
  }
  return rviz::StatusProperty::Error;
}

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool is_advertised(const std::string& topic, const std::string& type) {
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return false;
  return std::any_of(topics.begin(), topics.end(), [&](const ros::master::TopicInfo& advertised) {
    return advertised.name == topic && advertised.datatype == type;
  });
}

/// The topic `name` in the namespace of `topic`.
QString sibling(const QString& topic, const char* name) { return topic.left(topic.lastIndexOf('/') + 1) + name; }

}  // namespace

CameraDisplay::CameraDisplay()
    : properties_(this, {SLOT(subscribeInfo()), SLOT(subscribeParams()), SLOT(updateStyle())}),
      style_(properties_.style()),
      status_([this](StatusLevel level, const std::string& name,
                     const std::string& text) { setStatusStd(level_of(level), name, text); },
              [this](const std::string& name) { deleteStatusStd(name); }) {}

CameraDisplay::~CameraDisplay() = default;

void CameraDisplay::onInitialize() { figure_ = std::make_unique<CameraFigure>(scene_manager_, scene_node_); }

void CameraDisplay::onEnable() {
  subscribeInfo();
  subscribeParams();
}

void CameraDisplay::onDisable() {
  info_.unsubscribe();
  params_.unsubscribe();
  forget();
}

void CameraDisplay::reset() {
  Display::reset();
  // Subscribes again, because latched messages are received only once per subscription.
  if (isEnabled()) onEnable();
}

void CameraDisplay::subscribeInfo() {
  forget();
  if (isEnabled()) info_.subscribe(threaded_nh_, properties_.info_topic()->getTopicStd());
}

void CameraDisplay::subscribeParams() {
  if (isEnabled()) params_.subscribe(threaded_nh_, properties_.params_topic()->getTopicStd());
}

void CameraDisplay::updateStyle() {
  style_ = properties_.style();
  shape_changed_ = true;
}

void CameraDisplay::setTopic(const QString& topic, const QString& datatype) {
  auto* const info = properties_.info_topic();
  auto* const params = properties_.params_topic();
  auto* const named = datatype == params->getMessageType() ? params : info;
  auto* const other = named == info ? params : info;
  named->setString(topic);
  const QString beside = sibling(topic, named == info ? "params" : "camera_info");
  if (is_advertised(beside.toStdString(), other->getMessageType().toStdString())) other->setString(beside);
}

void CameraDisplay::forget() {
  lens_.forget();
  trail_.clear();
  shape_changed_ = true;
  if (figure_) figure_->set_visible(false);
  clearStatuses();
  status_.forget();
}

void CameraDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  const ros::Time now = ros::Time::now();
  if (info_.collect() == Added::restarted) trail_.clear();
  params_.collect();

  status_.begin(now, steady_seconds());
  const FixedFrame fixed(*context_->getFrameManager());
  const auto sample = choose(fixed, now);
  show_topic_status(now, sample ? sample->pose_fault : std::string());
  if (sample) draw(*sample, fixed);
  figure_->set_visible(sample.has_value());
}

std::optional<CameraDisplay::Sample> CameraDisplay::choose(const FixedFrame& fixed, const ros::Time& now) {
  if (!info_.alive(now, properties_.timeout())) {
    show_undrawn_status(/*transform_missing=*/false);
    return std::nullopt;
  }
  Sample sample;
  sample.info = info_.samples().newest([&](const sensor_msgs::CameraInfo& info) {
    const auto pose = fixed.pose_of(info.header.frame_id, info.header.stamp);
    if (pose) sample.fixed_T_optical = *pose;
    return pose.has_value();
  });
  if (!sample.info) {
    const auto newest = info_.samples().newest();
    status_.transform(fixed.why_unknown(newest->header.frame_id, newest->header.stamp));
    show_undrawn_status(/*transform_missing=*/true);
    return std::nullopt;
  }
  status_.transform("");
  if (params_.alive(now, properties_.timeout())) {
    sample.params = params_.samples().belonging_to(sample.info->header.stamp);
    if (const auto pose = camera::decode_pose(ros1::from_msg(*sample.params))) {
      sample.angles = camera::pan_tilt_roll(pose->linear());
    } else {
      sample.pose_fault = camera::describe(pose.error());
    }
  }
  return sample;
}

void CameraDisplay::draw(const Sample& sample, const FixedFrame& fixed) {
  if (lens_.update(*sample.info)) shape_changed_ = true;
  const double focus_distance = sample.params ? sample.params->focdist : 0;
  if (shape_changed_ || focus_distance != focus_distance_) {
    figure_->shape(lens_.border(), focus_distance, style_);
    rviz::applyVisibilityBits(getVisibilityBits(), getSceneNode());
    focus_distance_ = focus_distance;
    shape_changed_ = false;
  }
  figure_->place(sample.fixed_T_optical);
  follow(sample, fixed);
  figure_->draw(trail_, style_);
  const std::string name = properties_.name();
  figure_->write(name.empty() ? name_of_topic(info_.topic()) : name, values_text(sample), style_);
  show_drawn_status(sample);
}

void CameraDisplay::follow(const Sample& sample, const FixedFrame& fixed) {
  const std::string& fixed_frame = context_->getFrameManager()->getFixedFrame();
  if (fixed_frame != trail_fixed_frame_) {
    trail_.move([&fixed](const std::string& frame, const ros::Time& time) -> std::optional<Eigen::Vector3d> {
      const auto pose = fixed.pose_of(frame, time);
      if (!pose) return std::nullopt;
      return pose->translation();
    });
    trail_fixed_frame_ = fixed_frame;
  }
  const auto& header = sample.info->header;
  trail_.add(header.stamp.isZero() ? info_.last_arrival() : header.stamp, header.frame_id,
             sample.fixed_T_optical.translation(), style_.trail.length);
}

std::string CameraDisplay::values_text(const Sample& sample) const {
  const auto shown = properties_.values_shown();
  Values values;
  if (shown.pan_tilt_roll) {
    const Eigen::Matrix3d rotation = (sample.fixed_T_optical * ros1::camera_T_optical().inverse()).linear();
    values.pan_tilt_roll = sample.angles ? *sample.angles : camera::pan_tilt_roll(rotation);
  }
  if (shown.focal_length) {
    values.focal_length = lens_.focal_length();
    if (sample.params && (sample.params->format & trk_bridge::CameraParams::FIELD_OF_VIEW) == 0) {
      values.image_distance = sample.params->fov;
    }
  }
  if (shown.field_of_view && lens_.border() != nullptr) {
    values.field_of_view = Values::Angles{lens_.border()->horizontal, lens_.border()->vertical};
  }
  if (shown.counter && sample.params) values.counter = sample.params->counter;
  return text_of(values);
}

void CameraDisplay::show_topic_status(const ros::Time& now, const std::string& pose_fault) {
  const auto info = info_.state(now, properties_.timeout());
  const auto params = params_.state(now, properties_.timeout());
  status_.camera_info(info);
  status_.camera_params(params, pose_fault);
  status_.constants(info, params);
}

void CameraDisplay::show_drawn_status(const Sample& sample) {
  status_.lens(lens_);
  status_.frustum(style_.frustum.on, style_.frustum.near, style_.frustum.far);
  if (style_.focus_plane.on && sample.params) {
    status_.focus_plane(sample.params->focdist);
  } else {
    status_.no_focus_plane();
  }
  status_.age(sample.info->header.stamp, info_.last_arrival());
}

void CameraDisplay::show_undrawn_status(bool transform_missing) {
  status_.nothing_drawn(transform_missing);
  if (const auto newest = info_.samples().newest()) status_.age(newest->header.stamp, info_.last_arrival());
}

}  // namespace trk_bridge::rviz_display

PLUGINLIB_EXPORT_CLASS(trk_bridge::rviz_display::CameraDisplay, rviz::Display)
