// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Combines poses of tf and lenses of CameraInfo to parameters and constants for outlets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "camera_info.h"
#include "outgoing_set.h"
#include "trk_bridge/camera/converter.h"

namespace trk_bridge::bridge {

/// What neither tf nor CameraInfo contains.
struct TfToTrkOptions {
  wire::CameraConstants chip;  ///< its size in mm and its blanks in pixels; the image size comes from CameraInfo
  /// The camera's axes (x right, y forward, z up) in the frame of the poses: not the identity for poses of an optical
  /// frame.
  Eigen::Isometry3d frame_T_camera = Eigen::Isometry3d::Identity();
  double focdist = 0;   ///< m, until use_lens()
  double aperture = 0;  ///< f-stop, until use_lens()
};

/// Trivially copyable.
struct TfToTrkStatistics {
  std::uint64_t sets = 0;       ///< made for outlets
  std::int64_t last_set = 0;    ///< steady clock, ns; valid once sets > 0
  std::int64_t last_stamp = 0;  ///< of the last pose in a set, ns since 1970; 0: none, or a static pose
  std::uint64_t dropped = 0;    ///< poses that do not give a valid camera with their lens; reason: `drop_reason`
  camera::CameraReason drop_reason{};
  std::uint64_t infos = 0;          ///< received CameraInfo
  std::int64_t last_info = 0;       ///< steady clock, ns; valid once infos > 0
  std::uint64_t fits = 0;           ///< how many of them changed the calibration
  std::uint64_t refused_infos = 0;  ///< how many of them have no lens that trk can send
  bool info_is_refused = false;     ///< the last one was refused, because of `info_fault`
  InfoFault info_fault{};
  double residual = 0, tangential = 0, aspect = 0;  ///< px, see camera::FittedLens
  std::uint64_t bad_lenses = 0;                     ///< ignored calls of use_lens() with a value that is not finite
};

/// Stamps are ns since 1970; a static pose (from static transforms only) has stamp 0. Not synchronised: one thread at a
/// time. Allocates only when a CameraInfo changes the calibration.
class TfToTrk {
 public:
  /// The chip's size must be more than 0.
  explicit TfToTrk(const TfToTrkOptions&);

  /// `now` is the steady clock, ns, here and below.
  void use(const CameraInfo&, std::int64_t stamp, std::int64_t now);
  /// Focus (m) and aperture of the following sets.
  void use_lens(double focdist, double aperture) noexcept;

  /// Whether a pose with this stamp is newer than the last pose that was used or dropped. A static pose always is.
  bool is_new(std::int64_t stamp) const noexcept { return !last_pose_ || stamp == 0 || stamp > *last_pose_; }
  /// The clock of the poses was set: any stamp is new now, and the newest lens is used until others arrive.
  void restart() noexcept;
  /// Whether a lens with the same stamp can be expected soon: so far lenses had the stamps of poses, and that of this
  /// pose has not arrived.
  bool expects_lens(std::int64_t stamp) const noexcept;
  bool has_lens() const noexcept { return count_ > 0; }

  /// The set for a pose in the studio: canonical (euler, image distance in mm, shift on the chip, blanks considered),
  /// id 0, with the lens of the newest CameraInfo that is not newer than the pose. A static pose uses the newest
  /// CameraInfo, a pose older than all stored ones the oldest. If the newest CameraInfo is more than 1 s newer than the
  /// pose, their clocks differ, and the newest is used, too. None if there is no lens, or none that trk can send, or if
  /// the pose is not finite. The counter increases by one with every set.
  std::optional<OutgoingSet> make(const Eigen::Isometry3d& studio_T_frame, std::int64_t stamp, std::int64_t now);

  const TfToTrkStatistics& statistics() const noexcept { return statistics_; }

 private:
  struct StampedLens {
    std::int64_t stamp = 0;
    std::optional<camera::Lens> lens;  // none: the CameraInfo was refused
    std::int32_t width = 0, height = 0;
  };
  /// More than the CameraInfo that arrive while tf is delayed.
  static constexpr std::size_t history = 64;

  const StampedLens& newest(std::size_t back = 0) const noexcept;
  const StampedLens& lens_at(std::int64_t stamp) const noexcept;
  void fit(const CameraInfo&);

  const Eigen::Isometry3d frame_T_camera_;
  wire::CameraConstants chip_;  // with the image size of the last set
  double focdist_, aperture_;
  CameraInfo calibration_;              // the last one
  std::optional<camera::Lens> fitted_;  // its lens
  std::array<StampedLens, history> lenses_;
  std::uint64_t count_ = 0;  // of all received lenses
  bool in_step_ = true;
  std::optional<std::int64_t> last_pose_;
  std::uint64_t counter_ = 0;
  camera::Converter canonical_;  // knows what outlets have received
  TfToTrkStatistics statistics_;
};

}  // namespace trk_bridge::bridge
