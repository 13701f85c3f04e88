// A camera as markers, for viewers that take no plugins: frustum, optical axis, plane in focus, name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <sensor_msgs/CameraInfo.h>
#include <visualization_msgs/MarkerArray.h>

#include "camera/figure.h"
#include "trk_bridge/ros/camera_info.h"

namespace trk_bridge::ros1 {

/// Where the frustum begins, m.
inline constexpr double marker_near = 0.2;

/// What became of a camera's markers so far. Trivially copyable.
struct MarkerStatistics {
  std::uint64_t not_drawn = 0;  ///< CameraInfos whose lens cannot be drawn; `reason` of the last one
  InfoFault reason;
};

/// Makes four markers of every sample, each with id 0 in a namespace of its own: `<camera>/frustum` (LINE_LIST,
/// marker_near to `far`), `<camera>/axis` (LINE_LIST, to `far`), `<camera>/focus` (TRIANGLE_LIST) and `<camera>/name`
/// (TEXT_VIEW_FACING, above the camera). They are in the optical frame, m, and fixed where that was at their stamp.
/// What cannot be drawn has the action DELETE: the plane in focus where camera::draws_focus(focdist) is
/// false, everything where the lens cannot be drawn. Not synchronised. The border is computed anew only when the lens
/// changes.
class CameraMarkers {
 public:
  /// `far` (m) is more than marker_near; markers are to vanish `lifetime` seconds after the last ones came.
  CameraMarkers(const std::string& camera, const std::string& optical_frame, double far, double lifetime);

  /// The markers of a sample, stamped as `info` is. `focdist` in m.
  const visualization_msgs::MarkerArray& draw(const sensor_msgs::CameraInfo& info, double focdist);
  /// All four to be deleted.
  const visualization_msgs::MarkerArray& remove(const ::ros::Time& stamp);
  /// Whether the last call left anything to be seen.
  bool visible() const noexcept { return visible_; }

  const MarkerStatistics& statistics() const noexcept { return statistics_; }

 private:
  void take_lens(const sensor_msgs::CameraInfo&);
  void take_focus(double focdist);
  void stamp(const ::ros::Time&);

  double far_;
  bool visible_ = false;
  std::optional<sensor_msgs::CameraInfo> info_;  ///< whose border, or whose fault, is known
  std::optional<camera::ImageBorder> border_;
  double focdist_ = 0;  ///< that is drawn
  visualization_msgs::MarkerArray markers_;
  MarkerStatistics statistics_;
};

}  // namespace trk_bridge::ros1
