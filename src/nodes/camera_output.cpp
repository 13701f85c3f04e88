#include "camera_output.h"

#include <utility>

namespace trk_bridge::nodes {

CameraOutput::CameraOutput(::ros::NodeHandle node, const trk_bridge::ros1::CameraParameters& parameters,
                           double field_rate, int queue_size, ::ros::Publisher markers)
    : parameters_(parameters),
      pipeline_(parameters.options, parameters.frames, field_rate),
      field_rate_(field_rate),
      marker_topic_(std::move(markers)),
      log_(parameters.name) {
  if (parameters.publish_markers) {
    markers_.emplace(parameters.name, parameters.frames.optical, parameters.marker_far,
                     trk_bridge::ros1::silence_after(field_rate));
  }
  const auto queue = static_cast<std::uint32_t>(queue_size);
  params_ = node.advertise<trk_bridge::CameraParams>("params", queue);
  constants_ = node.advertise<trk_bridge::CameraConstants>("constants", queue, /*latch=*/true);
  if (parameters.options.publish_camera_info)
    camera_info_ = node.advertise<sensor_msgs::CameraInfo>("camera_info", queue);
  if (pipeline_.has_constants()) constants_.publish(pipeline_.constants());
  statistics_.store(pipeline_.statistics());
}

void CameraOutput::take(const transport::Sample& sample, std::int64_t now) {
  const auto made = pipeline_.process(sample, now);
  if (made.transform) transforms_.sendTransform(pipeline_.transform());
  if (made.params) params_.publish(pipeline_.params());
  if (made.camera_info) camera_info_.publish(pipeline_.camera_info());
  if (made.constants) constants_.publish(pipeline_.constants());
  statistics_.store(pipeline_.statistics());
  publish_markers(made);
}

/// Last of all: whoever looks at markers can wait.
void CameraOutput::publish_markers(const trk_bridge::ros1::PipelineOutput& made) {
  if (!markers_ || marker_topic_.getNumSubscribers() == 0) return;
  if (made.camera_info) {
    // Params that were withheld tell no focus.
    const double focdist = made.params ? pipeline_.params().focdist : 0;
    marker_topic_.publish(markers_->draw(pipeline_.camera_info(), focdist));
    marker_statistics_.store(markers_->statistics());
  } else if (markers_->visible() && !pipeline_.statistics().has_camera_info) {
    marker_topic_.publish(markers_->remove(pipeline_.camera_info().header.stamp));
  }
}

void CameraOutput::describe(trk_bridge::ros1::CameraReport report,
                            diagnostic_updater::DiagnosticStatusWrapper& status) {
  report.camera = statistics_.load();
  report.markers = marker_statistics_.load();
  const auto found = trk_bridge::ros1::findings(report, last_report_, parameters_.options, field_rate_);
  trk_bridge::ros1::fill(status, found, report, last_report_);
  log_.tell(found);
  last_report_ = std::move(report);
}

}  // namespace trk_bridge::nodes
