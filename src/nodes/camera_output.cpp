#include "camera_output.h"

#include <algorithm>

#include <ros/console.h>

namespace trk_bridge::nodes {

using diagnostic_msgs::DiagnosticStatus;

CameraOutput::CameraOutput(::ros::NodeHandle node, const trk_bridge::ros1::CameraParameters& parameters,
                           double field_rate, int queue_size)
    : pipeline_(parameters, field_rate), field_rate_(field_rate) {
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
  log_new(found);
  last_report_ = std::move(report);
}

void CameraOutput::log_new(const std::vector<trk_bridge::ros1::Finding>& found) {
  for (const auto& finding : found) {
    if (std::find(logged_.begin(), logged_.end(), finding.condition) != logged_.end()) continue;
    logged_.push_back(finding.condition);
    const std::string line = parameters().name + ": " + finding.text;
    switch (finding.level) {
      case DiagnosticStatus::ERROR:
        ROS_ERROR_STREAM(line);
        break;
      case DiagnosticStatus::WARN:
        ROS_WARN_STREAM(line << " (told once, then counted in the diagnostics)");
        break;
      default:
        ROS_INFO_STREAM(line);
        break;
    }
  }
}

}  // namespace trk_bridge::nodes
