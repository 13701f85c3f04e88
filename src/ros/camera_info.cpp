#include "trk_bridge/ros/camera_info.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace trk_bridge::ros1 {
namespace {

using camera::DistortionModel;

std::optional<InfoReason> fault_of_size(const sensor_msgs::CameraInfo& info) noexcept {
  constexpr std::uint32_t largest = std::numeric_limits<std::int32_t>::max();
  if (info.width == 0 || info.height == 0 || info.width > largest || info.height > largest) return InfoReason::no_size;
  return std::nullopt;
}

/// Of messages that do not tell of the whole image.
std::optional<InfoReason> fault_of_part(const sensor_msgs::CameraInfo& info) noexcept {
  if (info.binning_x > 1 || info.binning_y > 1) return InfoReason::binned;
  const auto& roi = info.roi;
  const bool no_region = roi.width == 0 && roi.height == 0;
  const bool whole = roi.width == info.width && roi.height == info.height;
  if (roi.x_offset != 0 || roi.y_offset != 0 || !(no_region || whole)) return InfoReason::region;
  return std::nullopt;
}

std::optional<InfoReason> fault_of_model(const sensor_msgs::CameraInfo& info) noexcept {
  const std::size_t count = info.D.size();
  if (info.distortion_model.empty() && count == 0) return std::nullopt;
  if (info.distortion_model == camera::name(DistortionModel::plumb_bob)) {
    if (count == 0 || count == 4 || count == 5) return std::nullopt;
    return InfoReason::coefficients;
  }
  if (info.distortion_model == camera::name(DistortionModel::rational_polynomial)) {
    if (count == 8) return std::nullopt;
    return InfoReason::coefficients;
  }
  return InfoReason::unknown_model;
}

std::array<double, 9> matrix_of(const sensor_msgs::CameraInfo& info) noexcept {
  std::array<double, 9> k{};
  std::copy(info.K.begin(), info.K.end(), k.begin());
  return k;
}

}  // namespace

std::string describe(const InfoFault& fault) {
  switch (fault.reason) {
    case InfoReason::no_size:
      return "width and height must be more than 0";
    case InfoReason::binned:
      return "binning_x and binning_y must be 0 or 1: the lens of the whole image is needed";
    case InfoReason::region:
      return "the region of interest must be the whole image: its lens is needed";
    case InfoReason::unknown_model:
      return "distortion_model must be plumb_bob or rational_polynomial";
    case InfoReason::coefficients:
      return "D must have 4 or 5 coefficients with plumb_bob, 8 with rational_polynomial";
    case InfoReason::no_lens:
      return camera::describe(fault.camera);
  }
  return "unknown reason";
}

tl::expected<camera::FittedLens, InfoFault> lens_of(const sensor_msgs::CameraInfo& info,
                                                    const wire::CameraConstants& chip) noexcept {
  for (const auto fault_of : {fault_of_size, fault_of_part, fault_of_model}) {
    if (const auto reason = fault_of(info)) return tl::unexpected(InfoFault{*reason, {}});
  }
  auto constants = chip;
  constants.image_width = static_cast<std::int32_t>(info.width);
  constants.image_height = static_cast<std::int32_t>(info.height);
  const auto lens = camera::fit_lens(matrix_of(info), info.D, constants);
  if (!lens) return tl::unexpected(InfoFault{InfoReason::no_lens, lens.error()});
  return *lens;
}

tl::expected<camera::ViewingLens, InfoFault> viewing_lens(const sensor_msgs::CameraInfo& info) {
  for (const auto fault_of : {fault_of_size, fault_of_model}) {
    if (const auto reason = fault_of(info)) return tl::unexpected(InfoFault{*reason, {}});
  }
  return camera::ViewingLens{matrix_of(info), info.D, info.width, info.height};
}

bool same_calibration(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) noexcept {
  return a.width == b.width && a.height == b.height && a.K == b.K && a.D == b.D &&
         a.distortion_model == b.distortion_model && a.binning_x == b.binning_x && a.binning_y == b.binning_y &&
         a.roi.x_offset == b.roi.x_offset && a.roi.y_offset == b.roi.y_offset && a.roi.width == b.roi.width &&
         a.roi.height == b.roi.height;
}

}  // namespace trk_bridge::ros1
