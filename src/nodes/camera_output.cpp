// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_output.h"

#include <utility>

#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {

CameraOutput::CameraOutput(::ros::NodeHandle node, const ros1::CameraParameters& parameters,
                           std::optional<double> field_rate, int queue_size, const ::ros::Publisher& markers)
    : parameters_(parameters),
      pipeline_(parameters.options, field_rate),
      messages_(parameters.frames),
      field_rate_(field_rate.value_or(bridge::assumed_field_rate)),
      marker_topic_(markers),
      options_(parameters.options),
      reporter_(parameters.name) {
  if (parameters.publish_markers) {
    markers_.emplace(parameters.name, parameters.frames.optical, parameters.marker_far,
                     bridge::silence_after(field_rate_));
  }
  const auto queue = static_cast<std::uint32_t>(queue_size);
  params_ = node.advertise<trk_bridge::CameraParams>("params", queue);
  constants_ = node.advertise<trk_bridge::CameraConstants>("constants", queue, /*latch=*/true);
  time_code_ = node.advertise<trk_bridge::TimeCode>("time_code", queue);
  lens_encoders_ = node.advertise<trk_bridge::LensEncoders>("lens_encoders", queue);
  if (parameters.options.publish_camera_info)
    camera_info_ = node.advertise<sensor_msgs::CameraInfo>("camera_info", queue);
  statistics_.store(pipeline_.statistics());
  make(pipeline_.initial());
  publish();
  publish_camera_info();
}

bridge::CameraUpdate CameraOutput::process(const transport::Sample& sample, std::int64_t now) {
  if (is_changed_.exchange(false, std::memory_order_acquire)) pipeline_.set(live_.load());
  auto update = pipeline_.begin(sample, now);
  statistics_.store(pipeline_.statistics());
  return update;
}

void CameraOutput::make(const bridge::CameraUpdate& update) {
  update_ = update;
  is_ready_ = true;
  messages_.make(update);
}

const geometry_msgs::TransformStamped* CameraOutput::transform() const noexcept {
  return is_ready_ && update_.pose ? &messages_.transform() : nullptr;
}

void CameraOutput::publish() {
  if (update_.params) params_.publish(messages_.params());
  if (update_.constants) constants_.publish(messages_.constants());
  if (update_.time_code) time_code_.publish(messages_.time_code());
  if (update_.encoders) lens_encoders_.publish(messages_.lens_encoders());
}

void CameraOutput::publish_camera_info() {
  if (update_.uncalibrated) {
    pipeline_.calibrate(update_);
    statistics_.store(pipeline_.statistics());
  }
  if (update_.calibration) {
    messages_.make_camera_info(update_);
    camera_info_.publish(messages_.camera_info());
  }
  publish_markers();
  is_ready_ = false;
}

/// Markers are published last, because they are not urgent.
void CameraOutput::publish_markers() {
  if (!markers_ || marker_topic_.getNumSubscribers() == 0) return;
  if (update_.calibration) {
    // The focus distance is only in params.
    const double focdist = update_.params ? update_.params->focdist : 0;
    marker_topic_.publish(markers_->draw(*messages_.camera_info(), focdist));
    marker_statistics_.store(markers_->statistics());
  } else if (update_.stamp > 0 && markers_->visible() && !pipeline_.statistics().has_camera_info) {
    marker_topic_.publish(markers_->remove(ros1::to_time(update_.stamp)));
  }
}

void CameraOutput::set(const bridge::LiveOptions& live) {
  static_cast<bridge::LiveOptions&>(options_) = live;
  live_.store(live);
  is_changed_.store(true, std::memory_order_release);
}

bridge::Status CameraOutput::describe(bridge::CameraReport report) {
  report.camera = statistics_.load();
  report.markers = marker_statistics_.load();
  return reporter_.status(std::move(report), options_, field_rate_);
}

}  // namespace trk_bridge::nodes
