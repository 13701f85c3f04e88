#include "camera_output.h"

namespace trk_bridge::nodes {

CameraOutput::CameraOutput(::ros::NodeHandle node, const trk_bridge::ros1::CameraParameters& parameters,
                           double field_rate, int queue_size)
    : pipeline_(parameters, field_rate), field_rate_(field_rate), log_(parameters.name) {
  const auto queue = static_cast<std::uint32_t>(queue_size);
  params_ = node.advertise<trk_bridge::CameraParams>("params", queue);
  constants_ = node.advertise<trk_bridge::CameraConstants>("constants", queue, /*latch=*/true);
  if (parameters.publish_camera_info) camera_info_ = node.advertise<sensor_msgs::CameraInfo>("camera_info", queue);
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
}

void CameraOutput::describe(trk_bridge::ros1::CameraReport report,
                            diagnostic_updater::DiagnosticStatusWrapper& status) {
  report.camera = statistics_.load();
  const auto found = trk_bridge::ros1::findings(report, last_report_, parameters(), field_rate_);
  trk_bridge::ros1::fill(status, found, report, last_report_);
  log_.tell(found);
  last_report_ = std::move(report);
}

}  // namespace trk_bridge::nodes
