#include "tf_to_trk.h"

#include <algorithm>
#include <cmath>

#include "trk_bridge/ros/frames.h"

namespace trk_bridge::ros1 {

TfToTrk::TfToTrk(const OutgoingForm& form, const TfToTrkOptions& options)
    : form_(form),
      is_optical_(options.camera_frame_is_optical),
      chip_(options.chip),
      focdist_(options.focdist),
      aperture_(options.aperture),
      outgoing_(form_.format) {}

void TfToTrk::take(const sensor_msgs::CameraInfo& info, std::int64_t now) {
  ++statistics_.infos;
  statistics_.last_info = now;
  if (statistics_.infos == 1 || !same_calibration(info, calibration_)) fit(info);
  if (statistics_.info_is_refused) ++statistics_.refused_infos;
  auto& lens = lenses_[count_ % history];
  ++count_;
  lens.stamp = info.header.stamp;
  lens.lens.reset();
  if (!fitted_) return;
  lens.lens = fitted_->lens;
  lens.width = static_cast<std::int32_t>(info.width);
  lens.height = static_cast<std::int32_t>(info.height);
}

void TfToTrk::fit(const sensor_msgs::CameraInfo& info) {
  calibration_ = info;
  ++statistics_.fits;
  const auto fitted = lens_of(info, chip_);
  statistics_.info_is_refused = !fitted;
  if (!fitted) {
    fitted_.reset();
    statistics_.info_fault = fitted.error();
    return;
  }
  fitted_ = *fitted;
  statistics_.residual = fitted->residual;
  statistics_.tangential = fitted->tangential;
  statistics_.aspect = fitted->aspect;
}

void TfToTrk::take_lens(const trk_bridge::CameraParams& message) {
  if (!std::isfinite(message.focdist) || !std::isfinite(message.aperture)) {
    ++statistics_.bad_lenses;
    return;
  }
  focdist_ = message.focdist;
  aperture_ = message.aperture;
}

bool TfToTrk::is_new(const ::ros::Time& stamp) const noexcept {
  constexpr double jump = 1.0;  // seconds
  if (!told_ || stamp.isZero()) return true;
  return stamp > *told_ || (*told_ - stamp).toSec() > jump;
}

const TfToTrk::StampedLens& TfToTrk::newest(std::size_t back) const noexcept {
  return lenses_[(count_ - 1 - back) % history];
}

const TfToTrk::StampedLens& TfToTrk::lens_at(const ::ros::Time& stamp) const noexcept {
  const std::size_t kept = std::min<std::uint64_t>(count_, history);
  if (stamp.isZero()) return newest();
  for (std::size_t back = 0; back < kept; ++back) {
    if (newest(back).stamp <= stamp) return newest(back);
  }
  return newest(kept - 1);
}

bool TfToTrk::expects_lens(const ::ros::Time& stamp) const noexcept {
  return in_step_ && !stamp.isZero() && (count_ == 0 || newest().stamp < stamp);
}

void TfToTrk::use_size(const StampedLens& lens) noexcept {
  if (outgoing_.get() != nullptr && chip_.image_width == lens.width && chip_.image_height == lens.height) return;
  chip_.image_width = lens.width;
  chip_.image_height = lens.height;
  outgoing_.use(chip_);
}

Outgoing TfToTrk::make(const geometry_msgs::TransformStamped& pose, std::int64_t now) {
  const ::ros::Time& stamp = pose.header.stamp;
  if (!has_lens()) return {};
  const StampedLens& at = lens_at(stamp);
  in_step_ = at.stamp == stamp;
  if (!at.lens) return {};
  use_size(at);
  camera::Camera camera;
  camera.pose = to_isometry(pose.transform);
  if (is_optical_) camera.pose = camera.pose * camera_T_optical().inverse();
  camera.lens = *at.lens;
  camera.lens.focdist = focdist_;
  camera.lens.aperture = aperture_;
  auto& count = statistics_.outgoing;
  const auto told = camera::encode(camera, form_.format, outgoing_.get());
  if (!told) {
    ++count.withheld;
    count.withhold_reason = told.error();
    return {};
  }
  Outgoing outgoing;
  outgoing.params = *told;
  outgoing.params->id = sent_id(form_, 0, count);
  outgoing.params->counter = ++counter_;
  outgoing.constants = outgoing_.news(outgoing.params->id);
  told_ = stamp;
  statistics_.last_stamp = static_cast<std::int64_t>(stamp.toNSec());
  ++count.sets;
  count.last_set = now;
  return outgoing;
}

}  // namespace trk_bridge::ros1
