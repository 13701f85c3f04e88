// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The rviz display "Camera".
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <rviz/display.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraParams.h>
#include <Eigen/Geometry>

#include "camera_status.h"
#include "display_properties.h"
#include "feed.h"
#include "lens_view.h"
#include "trail.h"
#include "trk_bridge/camera/camera.h"

namespace trk_bridge::rviz_display {

class FixedFrame;

/// Draws a tracked camera: its lens from CameraInfo, its pose from tf at the stamp of the CameraInfo, and data that
/// only CameraParams contain. Messages are received in the second thread of rviz and processed once per rendered frame.
class CameraDisplay : public rviz::Display {
  Q_OBJECT
 public:
  CameraDisplay();
  ~CameraDisplay() override;

  /// Called once per rendered frame.
  void update(float wall_dt, float ros_dt) override;
  /// Called when time went back, or when the user resets the display.
  void reset() override;
  /// Accepts topics of both types; the other topic is taken from the same namespace if it is advertised there.
  void setTopic(const QString& topic, const QString& datatype) override;

 private Q_SLOTS:
  void subscribeInfo();
  void subscribeParams();
  void updateStyle();

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private:
  /// The content of one rendered frame.
  struct Sample {
    boost::shared_ptr<const sensor_msgs::CameraInfo> info;
    boost::shared_ptr<const trk_bridge::CameraParams> params;  ///< null if there are none
    Eigen::Isometry3d fixed_T_optical = Eigen::Isometry3d::Identity();
    std::optional<camera::PanTiltRoll> angles;  ///< of `params`
    std::string pose_fault;                     ///< why `params` have no valid pose
  };

  void forget();
  std::optional<Sample> choose(const FixedFrame& fixed, const ros::Time& now);
  void draw(const Sample& sample, const FixedFrame& fixed);
  void follow(const Sample& sample, const FixedFrame& fixed);
  std::string values_text(const Sample& sample) const;
  void show_topic_status(const ros::Time& now, const std::string& pose_fault);
  void show_drawn_status(const Sample& sample);
  void show_undrawn_status(bool transform_missing);

  DisplayProperties properties_;
  FigureStyle style_;
  CameraStatus status_;
  Feed<sensor_msgs::CameraInfo> info_;
  Feed<trk_bridge::CameraParams> params_;

  LensView lens_;
  double focus_distance_ = 0;  // m, as drawn
  bool shape_changed_ = true;
  Trail trail_;
  std::string trail_fixed_frame_;  // the frame of its points
  std::unique_ptr<CameraFigure> figure_;
};

}  // namespace trk_bridge::rviz_display
