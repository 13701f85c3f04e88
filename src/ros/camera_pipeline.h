// One camera's way from samples to messages: judged, told in the published format, decoded, stamped.
#pragma once

#include <cstdint>
#include <optional>

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/camera.h"
#include "camera_options.h"
#include "stamper.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::ros1 {

/// Where the constants in use come from, the weightiest last.
enum class ConstantsOrigin : std::uint8_t {
  none,
  parameter,
  any_camera,  ///< received with id 0, which serve every camera of the source
  own,         ///< received with the camera's id, or with any where it has none
};

/// What became of a camera's records so far. Trivially copyable.
struct CameraStatistics {
  std::uint64_t params = 0;  ///< parameter records for this camera, of any order
  base::SequenceCounts sequence;
  std::uint64_t dropped = 0;      ///< news that were not published at all; `drop_reason` says why the last one was not
  std::uint64_t unstampable = 0;  ///< of these, those whose time no ROS time can tell
  std::uint64_t withheld = 0;     ///< params not published although tf was; `withhold_reason`
  std::uint64_t without_camera_info = 0;  ///< news without a CameraInfo although it is wanted; `info_reason`
  std::uint64_t bad_constants = 0;        ///< constants that leave no picture: ignored
  std::uint64_t id_changes = 0;           ///< how often a record had another id than the one before
  std::uint64_t held_stamps = 0;          ///< see Stamper
  std::int64_t stamp_ahead = 0;           ///< ns, see Stamper
  std::uint32_t last_id = 0;
  std::uint32_t last_format = 0;  ///< as received
  ConstantsOrigin constants = ConstantsOrigin::none;
  camera::CameraReason drop_reason{}, withhold_reason{}, info_reason{};
  bool has_camera_info = false;  ///< the last news had one
  double fit_residual = 0;       ///< pixels, of the last CameraInfo
  transport::Sender sender;      ///< of the last news
  std::int64_t last_news = 0;    ///< steady clock, ns; counts once sequence.accepted > 0
};

/// Which messages the last sample gave.
struct PipelineOutput {
  bool constants = false, params = false, camera_info = false, transform = false;
};

/// Not synchronised: one thread at a time. Messages are kept and overwritten, so that a sample allocates nothing.
class CameraPipeline {
 public:
  /// `field_rate` in Hz.
  CameraPipeline(const CameraOptions&, const CameraFrames&, double field_rate);

  /// Whether a record is this camera's.
  bool wants(const wire::Record&) const noexcept;

  /// Takes a record that wants() is true for. `now` is the steady clock's time of receipt, ns.
  PipelineOutput process(const transport::Sample&, std::int64_t now);

  /// Params, CameraInfo and transform of one sample bear one stamp.
  const trk_bridge::CameraParams& params() const noexcept { return params_; }
  const sensor_msgs::CameraInfo& camera_info() const noexcept { return camera_info_; }
  const geometry_msgs::TransformStamped& transform() const noexcept { return transform_; }
  /// Holds the parameter's constants from the start where there are any (then has_constants()).
  const trk_bridge::CameraConstants& constants() const noexcept { return constants_message_; }
  bool has_constants() const noexcept { return incoming_.has_value(); }

  const CameraStatistics& statistics() const noexcept { return statistics_; }

 private:
  PipelineOutput take(const wire::CameraConstants&, const transport::Sample&);
  PipelineOutput take(const wire::CameraParams&, const transport::Sample&, std::int64_t now);
  void use(const wire::CameraConstants&, ConstantsOrigin);
  PipelineOutput drop(camera::CameraReason);
  bool make_params(const wire::CameraParams&);
  bool make_camera_info(const camera::Result<camera::Lens>&);

  CameraOptions options_;
  base::Sequence sequence_;
  Stamper stamper_;
  camera::Calibrator calibrator_;
  std::optional<wire::CameraConstants> incoming_;
  wire::CameraConstants outgoing_;
  CameraStatistics statistics_;

  trk_bridge::CameraParams params_;
  trk_bridge::CameraConstants constants_message_;
  sensor_msgs::CameraInfo camera_info_;
  geometry_msgs::TransformStamped transform_;
};

}  // namespace trk_bridge::ros1
