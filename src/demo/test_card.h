// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A node that renders the pictures of a tracked camera from the published data, to check that the data are right.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>

#include <image_geometry/pinhole_camera_model.h>
#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "nodes/node_diagnostics.h"
#include "test_card_figure.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::demo {

/// Renders a test card in the studio as the camera of `params` and `constants` sees it, including distortion, to
/// `image_raw`, and rectifies it with the `camera_info` of the same stamp to `image_rect`, each only while it has
/// subscribers. `rectified/image` is the same as image_rect; its `rectified/camera_info` is published before each image
/// and has the same stamp and no distortion: so it is right also for viewers that use the newest CameraInfo for any
/// image, while the lens zooms. image_raw uses neither tf nor CameraInfo: so they can be compared with it. If rendering
/// takes longer than the period, a warning says that the pictures are too late for a comparison. The card is published
/// as markers on `test_card` (latched). The delay of the video, by which the stamps of pictures are later than those of
/// the params that they show, is published on `video_delay` (std_msgs/Float64, s, latched). All callbacks are called
/// from one thread.
class TestCard {
 public:
  /// Topics are in the namespace of `node`, parameters in that of `private_node` (test_card_parameters.h). Throws
  /// ParameterError.
  TestCard(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name);
  TestCard(const TestCard&) = delete;
  TestCard& operator=(const TestCard&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  void receive(const trk_bridge::CameraParamsConstPtr&);
  void receive(const sensor_msgs::CameraInfoConstPtr&);
  bool render(const trk_bridge::CameraParams&);
  void rectify(const sensor_msgs::CameraInfo&);
  void rectify_if_possible();
  bool rectified_wanted() const;
  /// Updates the average cost with the last picture.
  void note_cost();

  /// A problem, "" for none; logged when it changes.
  struct Problem {
    std::string reported;
    void report(const std::string& now);
  };

  Figure figure_;
  ::ros::Duration video_delay_;
  Clock::duration period_;
  Clock::time_point due_;

  std::optional<wire::CameraConstants> constants_;
  std::deque<sensor_msgs::CameraInfoConstPtr> infos_;  // oldest first
  sensor_msgs::Image image_, rectified_;
  ::ros::Time shown_;             // stamp of the params that image_ shows
  bool to_be_rectified_ = false;  // image_, when its CameraInfo has arrived
  image_geometry::PinholeCameraModel model_;
  Clock::duration spent_{};  // for the last picture
  double cost_ = 0;          // s per picture, average of the last ones
  Problem picture_problem_, rectification_problem_, speed_problem_;

  image_transport::Publisher images_, rectified_images_, paired_images_;
  ::ros::Publisher paired_infos_, markers_, delay_publisher_;
  ::ros::Subscriber params_subscriber_, constants_subscriber_, info_subscriber_;
  nodes::NodeDiagnostics diagnostics_;
};

}  // namespace trk_bridge::demo
