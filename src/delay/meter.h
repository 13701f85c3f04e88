// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures the delay between a camera's video and its tracking by comparing the motion in both.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "comparison.h"
#include "picture_motion.h"
#include "trk_bridge/camera/converter.h"
#include "trk_bridge/wire/record.h"
#include "turn.h"

namespace trk_bridge::delay {

/// Why the delay cannot be measured.
enum class CannotTell : std::uint8_t {
  no_constants,    ///< without them it is unknown how far a turn moves the picture
  other_shape,     ///< the aspect ratio of the pictures differs from that of the constants
  too_little,      ///< fewer than two seconds of video with tracking around them
  other_time,      ///< stamps of video and tracking do not overlap
  hardly_moved,    ///< the camera hardly moved
  picture_stood,   ///< tracking moved, but the picture did not, or nothing in it could be followed
  tracking_stood,  ///< the picture moved, but tracking did not
  disagree,        ///< the motions do not match at any delay
  too_even,        ///< the motion has no start or stop that could be compared
  out_of_range,    ///< the best delay is at the end of the searched range
};

/// One line of text for people.
const char* describe(CannotTell) noexcept;

inline constexpr std::array axis_names{"pan", "tilt", "roll"};  ///< in the order of Turn

/// One axis of tracking, measured against the picture.
struct Axis {
  bool moved = false;      ///< it moved enough; otherwise the other values are meaningless
  double scale = 0;        ///< motion of the picture divided by that of tracking: 1 is right, negative is a wrong sign
  double scale_error = 0;  ///< standard deviation of scale
  double correlation = 0;  ///< -1 to 1, at the delay
};

/// How fast the picture and tracking turned in the 0.2 s before a frame: pixels a second in the centre of the picture,
/// for roll of a point a quarter of the picture's width beside it.
struct Speeds {
  double time = 0;  ///< s, stamp of the frame relative to the first one
  Turn picture;
  Turn tracking;          ///< with its stamps
  Turn tracking_delayed;  ///< with its stamps plus the delay
};

/// The correlation of video and tracking when tracking is delayed by `delay` (s): 0 to 1.
struct DelayCorrelation {
  double delay = 0, correlation = 0;
};

/// Limits of the largest delay that is searched, s.
inline constexpr double min_search_range = 0.05, max_search_range = 5;

struct Measurement {
  std::optional<CannotTell> cannot_tell;  ///< if set, delay and axes are meaningless
  /// s. Positive: the video is later; a frame with stamp t shows the camera that tracking stamps with t - delay.
  double delay = 0;
  double accuracy = 0;           ///< its standard deviation, s
  double correlation = 0;        ///< at the delay, 0 to 1, over all axes
  double frame_interval = 0;     ///< s, median, of video
  double tracking_interval = 0;  ///< s, median
  double followed = 0;           ///< share of the frames whose motion is known
  std::array<Axis, 3> axes;
  /// The focal length of the picture divided by that of tracking, if pan or tilt show it, and its standard deviation.
  std::optional<double> focal_length_scale;
  double focal_length_error = 0;
  std::vector<Speeds> speeds;
  std::vector<DelayCorrelation> correlations;  ///< over all searched delays
};

/// Compares the turns of the picture with those of tracking at many delays of tracking: the best one, interpolated
/// between samples, is the delay of the video. Every axis has its own scale, which can be negative, so that a wrong
/// sign or a wrong focal length does not affect the delay. Translation of the camera is ignored: it should only turn
/// while it is measured. One camera; not synchronised.
class Meter {
 public:
  /// Searches delays from -`most_delay` to `most_delay` (s).
  explicit Meter(double most_delay = 0.5) : most_delay_(most_delay) {}

  /// The constants of the camera; there is no result without them. Invalid ones are not used.
  camera::ConstantsChange use(const wire::CameraConstants& constants) { return converter_.use(constants); }
  /// Adds a sample of tracking, in any format. `stamp` is ns since 1970; if it is not later than the last one, all
  /// earlier tracking is discarded. The error is the reason why a sample is ignored.
  camera::Result<void> add(std::int64_t stamp, const wire::CameraParams&);
  /// Adds a frame of video, CV_8UC1, of the full picture in any resolution. A stamp that is not later than the last one
  /// discards all earlier video.
  void add(std::int64_t stamp, const cv::Mat& grey);
  /// Discards frames and samples that are more than this time older than the newest frame or sample.
  void keep(double seconds);

  Measurement measure() const;

 private:
  struct Sample {
    std::int64_t stamp;
    Eigen::Matrix3d rotation;  // studio_R_camera
    camera::Lens lens;
  };
  struct Frame {
    std::int64_t before, stamp;
    cv::Size size;
    std::vector<MovedPoint> points;
  };
  /// The turn since the frame before, in the pixels of Speeds, with the focal length of tracking times a scale.
  std::optional<Turn> turn_in(const Frame&, const camera::Raster&, double focal_length_scale) const;
  /// Spans of `length` frames each.
  std::vector<Span> spans_of(const std::vector<const Frame*>&, const camera::Raster&, std::size_t length,
                             double focal_length_scale) const;
  /// Over seconds from the first sample on, in the pixels of Speeds.
  Path tracked_path(const camera::Raster&) const;
  /// The frames for which the path has the turns at all delays that are searched. `interval` is set to the median of
  /// all frames, s.
  std::vector<const Frame*> frames_within(const Path&, double& interval) const;
  void find_delay(const Comparison&, Measurement&) const;

  double most_delay_;
  camera::Converter converter_;
  std::deque<Sample> samples_;
  PictureMotion motion_;
  std::int64_t last_frame_ = 0;
  std::deque<Frame> frames_;
};

}  // namespace trk_bridge::delay
