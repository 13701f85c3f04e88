// Poses of tf and lenses of CameraInfo, put together as parameters and constants for outlets.
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

/// What neither tf nor CameraInfo knows.
struct TfToTrkOptions {
  wire::CameraConstants chip;  ///< its size in mm and its blanks in pixels; the image's size is CameraInfo's
  /// The camera's axes (x right, y forward, z up) in the frame whose poses come: another one than the identity for
  /// poses of an optical frame.
  Eigen::Isometry3d frame_T_camera = Eigen::Isometry3d::Identity();
  double focdist = 0;   ///< m, until use_lens()
  double aperture = 0;  ///< f-stop, likewise
};

/// Trivially copyable.
struct TfToTrkStatistics {
  std::uint64_t sets = 0;       ///< made for outlets
  std::int64_t last_set = 0;    ///< steady clock, ns; valid once sets > 0
  std::int64_t last_stamp = 0;  ///< of the last pose in a set, ns since 1970; 0: none or of a static pose
  std::uint64_t dropped = 0;    ///< poses that with their lens are no camera; `drop_reason`
  camera::CameraReason drop_reason{};
  std::uint64_t infos = 0;          ///< CameraInfo that came
  std::int64_t last_info = 0;       ///< steady clock, ns; valid once infos > 0
  std::uint64_t fits = 0;           ///< how many of them had another calibration than the one before
  std::uint64_t refused_infos = 0;  ///< of them, those without a lens that trk can send
  bool info_is_refused = false;     ///< the last one is, for `info_fault`
  InfoFault info_fault{};
  double residual = 0, tangential = 0, aspect = 0;  ///< px, see camera::FittedLens
  std::uint64_t bad_lenses = 0;                     ///< calls of use_lens() with a value that is not finite: ignored
};

/// Stamps are ns since 1970; that of a static pose (of static transforms alone) is 0. Not synchronised: one thread at a
/// time. Allocates only when a CameraInfo brings another calibration.
class TfToTrk {
 public:
  /// The chip's size must be more than 0.
  explicit TfToTrk(const TfToTrkOptions&);

  /// `now` is the steady clock, ns, here and below.
  void use(const CameraInfo&, std::int64_t stamp, std::int64_t now);
  /// Focus (m) and aperture of the sets from now on.
  void use_lens(double focdist, double aperture) noexcept;

  /// Whether a pose of this stamp is newer than the last one that a set was made of or that was dropped. A static pose
  /// always is.
  bool is_new(std::int64_t stamp) const noexcept { return !last_pose_ || stamp == 0 || stamp > *last_pose_; }
  /// The clock of the poses was set: any stamp is new now, and the newest lens is that of any pose until others come.
  void restart() noexcept;
  /// Whether waiting for a moment may bring a lens of the same stamp: so far lenses had the stamps of poses, and the
  /// one of this pose has not come.
  bool expects_lens(std::int64_t stamp) const noexcept;
  bool has_lens() const noexcept { return count_ > 0; }

  /// The set for a pose in the studio: canonical (euler, image distance in mm, shift on the chip, blanks considered),
  /// id 0, with the lens of the newest CameraInfo that is not newer than the pose: for a static pose the newest one of
  /// all, for a pose older than all that are kept the oldest of them. Where the newest CameraInfo is more than 1 s
  /// newer than the pose, their clocks do not agree, and it is used, too. None where there is no lens, or none that trk
  /// can send, or the pose is not finite. The counter goes up by one with every set.
  std::optional<OutgoingSet> make(const Eigen::Isometry3d& studio_T_frame, std::int64_t stamp, std::int64_t now);

  const TfToTrkStatistics& statistics() const noexcept { return statistics_; }

 private:
  struct StampedLens {
    std::int64_t stamp = 0;
    std::optional<camera::Lens> lens;  // none: the CameraInfo was refused
    std::int32_t width = 0, height = 0;
  };
  /// More than the CameraInfo that come while tf is on its way.
  static constexpr std::size_t history = 64;

  const StampedLens& newest(std::size_t back = 0) const noexcept;
  const StampedLens& lens_at(std::int64_t stamp) const noexcept;
  void fit(const CameraInfo&);

  const Eigen::Isometry3d frame_T_camera_;
  wire::CameraConstants chip_;  // with the size of the last set's image
  double focdist_, aperture_;
  CameraInfo calibration_;              // the last one
  std::optional<camera::Lens> fitted_;  // its lens
  std::array<StampedLens, history> lenses_;
  std::uint64_t count_ = 0;  // of all lenses so far
  bool in_step_ = true;
  std::optional<std::int64_t> last_pose_;
  std::uint64_t counter_ = 0;
  camera::Converter canonical_;  // remembers what outlets have
  TfToTrkStatistics statistics_;
};

}  // namespace trk_bridge::bridge
