// The delay between a camera's video and its tracking, measured from what both show of its motion.
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

/// Why there is no delay.
enum class CannotTell : std::uint8_t {
  no_constants,    ///< without them nobody knows how far a turn moves the picture
  other_shape,     ///< pictures have another ratio of width and height than the constants
  too_little,      ///< fewer than two seconds of video with tracking around them
  other_time,      ///< stamps of video and tracking do not overlap
  hardly_moved,    ///< the camera hardly moved
  picture_stood,   ///< tracking moved and the picture did not, or nothing in it could be followed
  tracking_stood,  ///< the picture moved and tracking did not
  disagree,        ///< no delay makes the two alike
  too_even,        ///< the motion has no beginning and no end that could be compared
  out_of_range,    ///< the best delay is at the end of those tried
};

/// A line for a person.
const char* describe(CannotTell) noexcept;

inline constexpr std::array axis_names{"pan", "tilt", "roll"};  ///< in the order of Turn

/// What the picture says of one axis of tracking.
struct Axis {
  bool moved = false;      ///< enough to be judged; else the numbers say nothing
  double scale = 0;        ///< the picture's motion over tracking's: 1 is right, negative turns the wrong way
  double scale_error = 0;  ///< standard deviation of scale
  double correlation = 0;  ///< -1 to 1, at the delay
};

/// How fast the picture and tracking turned in the fifth of a second before a frame: pixels a second of the picture's
/// middle, and for roll of a point a quarter of the picture's width beside it.
struct Speeds {
  double time = 0;  ///< s, of the frame's stamp, from the first one
  Turn picture;
  Turn tracking;          ///< as it is stamped
  Turn tracking_delayed;  ///< by the delay
};

/// How alike video and tracking are when tracking is delayed by `delay` (s): 0 to 1.
struct Likeness {
  double delay = 0, correlation = 0;
};

/// Delays that may be asked for as the largest one, s.
inline constexpr double least_most_delay = 0.05, most_most_delay = 5;

struct Measurement {
  std::optional<CannotTell> cannot_tell;  ///< if set, the delay and what is said of the axes mean nothing
  /// s. Positive: the video is later, a frame of stamp t shows the camera as tracking stamps it with t - delay.
  double delay = 0;
  double accuracy = 0;           ///< its standard deviation, s
  double correlation = 0;        ///< at the delay, 0 to 1, over all axes
  double frame_interval = 0;     ///< s, median, of video
  double tracking_interval = 0;  ///< s, median
  double followed = 0;           ///< part of the frames that the picture's motion is known for
  std::array<Axis, 3> axes;
  /// The picture's focal length over tracking's, where pan or tilt tell it, and its standard deviation.
  std::optional<double> focal_length_scale;
  double focal_length_error = 0;
  std::vector<Speeds> speeds;
  std::vector<Likeness> likeness;  ///< over all delays that were tried
};

/// Turns of the picture and of tracking are compared as if tracking were delayed by each of many delays: the best one,
/// found between samples, is the video's. Every axis has a scale of its own, also a negative one, so that a wrong sign
/// or a wrong focal length does not spoil the delay. Travel of the camera is not considered: while measuring it should
/// stand and turn. One camera; not synchronised.
class Meter {
 public:
  /// Delays from -`most_delay` to `most_delay` (s) are tried.
  explicit Meter(double most_delay = 0.5) : most_delay_(most_delay) {}

  /// The camera's constants, without which there is no result. Unsound ones are not used.
  camera::ConstantsChange use(const wire::CameraConstants& constants) { return converter_.use(constants); }
  /// A sample of tracking, in any format. `stamp` is ns since 1970; one that is not later than the last forgets all of
  /// tracking. The error is why it was left out.
  camera::Result<void> add(std::int64_t stamp, const wire::CameraParams&);
  /// A frame of video, CV_8UC1, of the whole picture in any resolution. As above, a stamp that is not later than the
  /// last forgets all of the video.
  void add(std::int64_t stamp, const cv::Mat& grey);
  /// Forgets what is older than so many seconds before the newest frame, and the newest sample.
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
  /// Since the frame before, in the pixels of Speeds, with tracking's focal length times a scale.
  std::optional<Turn> turn_in(const Frame&, const camera::Raster&, double focal_length_scale) const;
  /// Of `length` frames each.
  std::vector<Span> spans_of(const std::vector<const Frame*>&, const camera::Raster&, std::size_t length,
                             double focal_length_scale) const;
  /// Over seconds from the first sample on, in the pixels of Speeds.
  Path tracked_path(const camera::Raster&) const;
  void find_delay(const Comparison&, Measurement&) const;

  double most_delay_;
  camera::Converter converter_;
  std::deque<Sample> samples_;
  PictureMotion motion_;
  std::int64_t last_frame_ = 0;
  std::deque<Frame> frames_;
};

}  // namespace trk_bridge::delay
