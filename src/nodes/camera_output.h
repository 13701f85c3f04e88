// One camera's topics, fed by its pipeline.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "bridge/camera_pipeline.h"
#include "bridge/diagnostics.h"
#include "ros/camera_messages.h"
#include "ros/markers.h"
#include "ros/trk_to_ros_parameters.h"
#include "status_reporter.h"
#include "trk_bridge/base/snapshot.h"

namespace trk_bridge::nodes {

/// Publishing is apart from processing: the tf of several cameras goes out as one message, before the rest, and a
/// CameraInfo, whose lens has to be fitted, after all that does not need it. All but set() and describe() belongs to
/// one reader's thread, these to that of the node's callbacks.
class CameraOutput {
 public:
  /// Advertises `params`, `constants`, `camera_info`, `time_code` and `lens_encoders` in the namespace of `node`, and
  /// publishes the parameter's constants where there are any. `markers` is a topic that cameras share; it is used only
  /// where publish_markers is set.
  CameraOutput(::ros::NodeHandle node, const ros1::CameraParameters&, std::optional<double> field_rate, int queue_size,
               const ::ros::Publisher& markers);

  bool wants(const wire::Record& record) const noexcept { return pipeline_.wants(record); }
  /// What comes of a sample, not calibrated. `now` is the steady clock's time of receipt, ns.
  bridge::CameraUpdate process(const transport::Sample&, std::int64_t now);
  /// Makes the messages of an update that is not empty. Those of the one before must have been published.
  void make(const bridge::CameraUpdate&);
  /// Whether there is anything to publish.
  bool is_ready() const noexcept { return is_ready_; }
  /// The transform among it; null: none.
  const geometry_msgs::TransformStamped* transform() const noexcept;
  /// Publishes it, but for the transform and the CameraInfo, before it returns.
  void publish();
  /// Makes and publishes the CameraInfo, and the markers: the last of what is ready.
  void publish_camera_info();

  /// Changes what can be changed, from the next sample on. For the thread of describe().
  void set(const bridge::LiveOptions&);
  const bridge::LiveOptions& live() const noexcept { return options_; }

  /// `report` is of this moment but for the camera's part, which is added here. Findings of a kind that was not met
  /// before go to the log, too.
  bridge::Status describe(bridge::CameraReport report);

  /// As they were given.
  const ros1::CameraParameters& parameters() const noexcept { return parameters_; }

 private:
  void publish_markers();

  const ros1::CameraParameters parameters_;
  bridge::CameraPipeline pipeline_;
  bridge::CameraUpdate update_;
  bool is_ready_ = false;
  ros1::CameraMessages messages_;  // of update_
  std::optional<ros1::CameraMarkers> markers_;
  double field_rate_;
  ::ros::Publisher params_, constants_, camera_info_, time_code_, lens_encoders_, marker_topic_;
  bridge::CameraOptions options_;  // with what was changed since, of the thread of describe()
  base::Snapshot<bridge::LiveOptions> live_;
  std::atomic<bool> is_changed_{false};
  base::Snapshot<bridge::CameraStatistics> statistics_;
  base::Snapshot<bridge::MarkerStatistics> marker_statistics_;
  StatusReporter<bridge::CameraReport> reporter_;
};

}  // namespace trk_bridge::nodes
