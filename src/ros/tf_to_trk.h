// Poses of tf and lenses of CameraInfo on their way to sinks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraParams.h>

#include "trk_bridge/ros/camera_info.h"
#include "outgoing.h"

namespace trk_bridge::ros1 {

/// What neither tf nor CameraInfo can tell.
struct TfToTrkOptions {
  wire::CameraConstants chip;            ///< its size in mm and its blanks in pixels; the image's size is CameraInfo's
  bool camera_frame_is_optical = false;  ///< x right, y down, z forward (REP 103) instead of x right, y forward, z up
  double focdist = 0;                    ///< m, until the `lens` topic tells it
  double aperture = 0;                   ///< f-stop, likewise
};

/// Trivially copyable.
struct TfToTrkStatistics {
  OutgoingStatistics outgoing;
  std::int64_t last_stamp = 0;      ///< of the last pose that was told, ns since 1970; 0: none or of a pose for ever
  std::uint64_t infos = 0;          ///< CameraInfo messages
  std::int64_t last_info = 0;       ///< steady clock, ns; counts once infos > 0
  std::uint64_t fits = 0;           ///< how many of them had another calibration than the one before
  std::uint64_t refused_infos = 0;  ///< of them, those without a lens that trk could tell
  bool info_is_refused = false;     ///< the last one is, for `info_fault`
  InfoFault info_fault{};
  double residual = 0, tangential = 0, aspect = 0;  ///< px, see camera::FittedLens
  std::uint64_t bad_lenses = 0;  ///< messages of the lens topic whose focus or aperture is not finite: ignored
};

/// Not synchronised: one thread at a time. Allocates only when a CameraInfo brings another calibration.
class TfToTrk {
 public:
  /// The chip's size must be more than 0.
  TfToTrk(const OutgoingForm&, const TfToTrkOptions&);

  /// `now` is the steady clock, ns, here and below.
  void take(const sensor_msgs::CameraInfo&, std::int64_t now);
  /// Focus and aperture, the only things that count of it.
  void take_lens(const trk_bridge::CameraParams&);

  /// Whether a pose of this stamp is newer than the last one that was told. A pose that is for ever (zero: static
  /// transforms alone) always is, as is one older by more than a second, for then time itself jumped back.
  bool is_new(const ::ros::Time& stamp) const noexcept;
  /// Whether waiting for a moment may bring a lens of the same stamp: so far lenses had the stamps of poses, and the
  /// one of this pose has not come.
  bool expects_lens(const ::ros::Time& stamp) const noexcept;
  bool has_lens() const noexcept { return count_ > 0; }

  /// The set for a pose of the camera's frame in the studio frame: with the lens of the newest CameraInfo that is not
  /// newer than it. Nothing where there is no lens, or it is none that trk can tell, or the set cannot be told in the
  /// format. The counter goes up by one with every set.
  Outgoing make(const geometry_msgs::TransformStamped& pose, std::int64_t now);

  const TfToTrkStatistics& statistics() const noexcept { return statistics_; }

 private:
  struct StampedLens {
    ::ros::Time stamp;
    std::optional<camera::Lens> lens;  // none: the CameraInfo was refused
    std::int32_t width = 0, height = 0;
  };
  /// More than the CameraInfo that come while tf is on its way.
  static constexpr std::size_t history = 64;

  const StampedLens& newest(std::size_t back = 0) const noexcept;
  const StampedLens& lens_at(const ::ros::Time& stamp) const noexcept;
  void fit(const sensor_msgs::CameraInfo&);
  void use_size(const StampedLens&) noexcept;

  OutgoingForm form_;
  bool is_optical_;
  wire::CameraConstants chip_;  // with the size of the image told last
  double focdist_, aperture_;
  sensor_msgs::CameraInfo calibration_;  // the last one, fitted to `fitted_`
  std::optional<camera::FittedLens> fitted_;
  std::array<StampedLens, history> lenses_;
  std::uint64_t count_ = 0;  // of all lenses so far
  bool in_step_ = true;
  std::optional<::ros::Time> told_;
  std::uint64_t counter_ = 0;
  OutgoingConstants outgoing_;
  TfToTrkStatistics statistics_;
};

}  // namespace trk_bridge::ros1
