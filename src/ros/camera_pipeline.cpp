#include "camera_pipeline.h"

#include <cmath>
#include <cstring>

#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::ros1 {
namespace {

using camera::CameraReason;

std::chrono::nanoseconds nanoseconds_of(double seconds) {
  return std::chrono::nanoseconds(std::llround(seconds * 1e9));
}

}  // namespace

CameraPipeline::CameraPipeline(const CameraOptions& options, const CameraFrames& frames, double field_rate)
    : options_(options), sequence_(field_rate), stamper_(nanoseconds_of(options.delay)) {
  params_.header.frame_id = frames.studio;
  constants_message_.header.frame_id = frames.camera;
  camera_info_.header.frame_id = frames.optical;
  // For the longer of both models, so that a change of the lens allocates nothing.
  camera_info_.D.reserve(8);
  camera_info_.distortion_model.reserve(std::strlen(camera::name(camera::DistortionModel::rational_polynomial)));
  transform_.header.frame_id = frames.studio;
  transform_.child_frame_id = frames.camera;
  if (options.constants) use(*options.constants, ConstantsOrigin::parameter);
}

bool CameraPipeline::wants(const wire::Record& record) const noexcept {
  if (!options_.id) return true;
  if (const auto* params = std::get_if<wire::CameraParams>(&record)) return params->id == *options_.id;
  const auto* constants = std::get_if<wire::CameraConstants>(&record);
  return constants != nullptr && (constants->id == *options_.id || constants->id == 0);
}

PipelineOutput CameraPipeline::process(const transport::Sample& sample, std::int64_t now) {
  if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) return take(*params, sample, now);
  if (const auto* constants = std::get_if<wire::CameraConstants>(&sample.record)) return take(*constants, sample);
  return {};
}

void CameraPipeline::use(const wire::CameraConstants& constants, ConstantsOrigin origin) {
  incoming_ = constants;
  outgoing_ = options_.format ? camera::constants_for(constants, *options_.format) : constants;
  statistics_.constants = origin;
  to_msg(outgoing_, constants_message_);
}

PipelineOutput CameraPipeline::take(const wire::CameraConstants& constants, const transport::Sample& sample) {
  const bool own = !options_.id || constants.id == *options_.id;
  const auto origin = own ? ConstantsOrigin::own : ConstantsOrigin::any_camera;
  if (origin < statistics_.constants) return {};
  if (!camera::check(constants)) {
    ++statistics_.bad_constants;
    return {};
  }
  const bool same = incoming_ && *incoming_ == constants;
  use(constants, origin);
  if (same) return {};
  // Out of ROS time is no reason to keep constants back: zero means that no time is known.
  constants_message_.header.stamp =
      to_time(sample.arrival - nanoseconds_of(options_.delay).count()).value_or(::ros::Time());
  PipelineOutput output;
  output.constants = true;
  return output;
}

PipelineOutput CameraPipeline::drop(CameraReason reason) {
  ++statistics_.dropped;
  statistics_.drop_reason = reason;
  return {};
}

PipelineOutput CameraPipeline::take(const wire::CameraParams& params, const transport::Sample& sample,
                                    std::int64_t now) {
  if (statistics_.params > 0 && params.id != statistics_.last_id) ++statistics_.id_changes;
  ++statistics_.params;
  statistics_.last_id = params.id;
  statistics_.last_format = params.format;
  const auto order = sequence_.judge(params.counter);
  statistics_.sequence = sequence_.counts();
  if (!base::is_new(order)) return {};
  statistics_.last_news = now;
  statistics_.sender = sample.sender;

  const auto pose = camera::decode_pose(params);
  if (!pose) return drop(pose.error());
  const auto lens = camera::decode_lens(params, incoming_ ? &*incoming_ : nullptr);
  if (!lens && lens.error() == CameraReason::not_finite) return drop(lens.error());
  const auto stamp = stamper_.stamp(sample.arrival);
  if (!stamp) {
    ++statistics_.dropped;
    ++statistics_.unstampable;
    return {};
  }
  statistics_.held_stamps = stamper_.held();
  statistics_.stamp_ahead = stamper_.ahead();

  PipelineOutput output;
  params_.header.stamp = camera_info_.header.stamp = transform_.header.stamp = *stamp;
  output.params = make_params(params);
  output.camera_info = options_.publish_camera_info && make_camera_info(lens);
  if (options_.publish_tf) {
    transform_.transform = to_transform(*pose);
    output.transform = true;
  }
  return output;
}

bool CameraPipeline::make_params(const wire::CameraParams& params) {
  if (!options_.format) {
    to_msg(params, params_);
    return true;
  }
  const auto* incoming = incoming_ ? &*incoming_ : nullptr;
  const auto* outgoing = incoming_ ? &outgoing_ : nullptr;
  const auto told = camera::reexpress(params, *options_.format, incoming, outgoing);
  if (!told) {
    ++statistics_.withheld;
    statistics_.withhold_reason = told.error();
    return false;
  }
  to_msg(*told, params_);
  return true;
}

bool CameraPipeline::make_camera_info(const camera::Result<camera::Lens>& lens) {
  const auto refuse = [this](CameraReason reason) {
    ++statistics_.without_camera_info;
    statistics_.info_reason = reason;
    statistics_.has_camera_info = false;
    return false;
  };
  if (!incoming_) return refuse(CameraReason::constants_needed);
  if (!lens) return refuse(lens.error());
  const auto calibration = calibrator_.calibrate(*lens, *incoming_);
  if (!calibration) return refuse(calibration.error());
  to_msg(*calibration, camera_info_);
  statistics_.has_camera_info = true;
  statistics_.fit_residual = calibration->distortion.residual;
  return true;
}

}  // namespace trk_bridge::ros1
