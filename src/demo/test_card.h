// The node that makes the pictures of a tracked camera out of what is published about it, to see whether that is right.
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

/// Renders a test card in the studio as the camera of `params` and `constants` sees it, distortion and all, into
/// `image_raw`, and rectifies that by the `camera_info` of the same stamp into `image_rect`, each only while somebody
/// subscribes. `rectified/image` is image_rect again, with a `rectified/camera_info` that comes before each image and
/// has its stamp and no distortion: viewers that take the newest CameraInfo for any image are right then while the lens
/// zooms. Neither tf nor CameraInfo has a part in image_raw: whether they agree with it can be seen and measured.
/// Where pictures take longer than the time between them, a warning says that they come too late to be compared.
/// The card itself is published as markers, latched, on `test_card`, and the delay of the video, that pictures are
/// stamped later than the params that they show (std_msgs/Float64, s), latched on `video_delay`. All callbacks come
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
  /// The picture before is done.
  void note_cost();

  /// What is wrong, "" for nothing: logged when it changes.
  struct Trouble {
    std::string reported;
    void report(const std::string& now);
  };

  Figure figure_;
  ::ros::Duration video_delay_;
  Clock::duration period_;
  Clock::time_point due_;

  std::optional<wire::CameraConstants> constants_;
  std::deque<sensor_msgs::CameraInfoConstPtr> infos_;  // the newest ones, the last is the newest
  sensor_msgs::Image image_, rectified_;
  ::ros::Time shown_;             // stamp of the params that image_ shows
  bool to_be_rectified_ = false;  // image_, once its CameraInfo has come
  image_geometry::PinholeCameraModel model_;
  Clock::duration spent_{};  // on the picture that was begun last
  double cost_ = 0;          // s, of a picture, on the average of the last ones
  Trouble picture_trouble_, rectification_trouble_, speed_trouble_;

  image_transport::Publisher images_, rectified_images_, paired_images_;
  ::ros::Publisher paired_infos_, markers_, delay_publisher_;
  ::ros::Subscriber params_subscriber_, constants_subscriber_, info_subscriber_;
  nodes::NodeDiagnostics diagnostics_;
};

}  // namespace trk_bridge::demo
