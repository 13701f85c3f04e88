// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "meter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "comparison.h"

namespace trk_bridge::delay {
namespace {

constexpr double least_time = 2;           // s of video
constexpr double longest_interval = 0.15;  // s between frames of one shot
// Turns are compared over this time (s), not from frame to frame: then the jitter of stamps hardly matters.
constexpr double span_time = 0.2;
constexpr double step = 0.005;        // s between searched delays: camera motion has no finer detail
constexpr double least_speed = 0.01;  // picture widths a second, RMS: slower motion is noise
constexpr double least_correlation = 0.7;
constexpr double worst_accuracy = 0.005;  // s
constexpr double worst_scale_error = 0.1;
constexpr double worst_focal_length_error = 0.01;  // not used if it is larger
constexpr double same_shape = 0.01;

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

/// Converts radians to the unit in which turns are compared: pixels in the centre of the picture, for roll of a point
/// beside it.
Turn pixels(const camera::Raster& raster, double image_distance) {
  return {raster.mx * image_distance, raster.mx * image_distance, raster.width / 4};
}

double speed(const Turn& squares, std::size_t spans) {
  return std::sqrt(squares.sum() / static_cast<double>(std::max<std::size_t>(spans, 1))) / span_time;
}

/// Whether a turn differs much from those of the neighbouring frames. Cameras do not move like that: the picture was
/// matched to a wrong part of a repetitive pattern.
bool is_jump(const std::vector<std::optional<Turn>>& turns, std::size_t i, double width) {
  constexpr std::size_t about = 2;            // frames to each side
  constexpr double far = 0.02, factor = 0.5;  // of the picture's width, and of the turn of the others
  const std::size_t begin = i < about ? 0 : i - about, end = std::min(i + about + 1, turns.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> others;
    for (std::size_t k = begin; k < end; ++k) {
      if (turns[k]) others.push_back((*turns[k])[axis]);
    }
    const double usual = median(others);
    if (std::abs((*turns[i])[axis] - usual) > far * width + factor * std::abs(usual)) return true;
  }
  return false;
}

/// Mean of the scales of pan and tilt that have the right sign, weighted by their errors.
void find_focal_length(Measurement& result) {
  constexpr double perfect = 1e-4;  // lower limit of the errors
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Axis& axis = result.axes[i];
    if (!axis.moved || axis.scale <= 0) continue;
    const double weight = 1 / (axis.scale_error * axis.scale_error + perfect * perfect);
    sum += weight * axis.scale;
    weights += weight;
  }
  if (weights == 0) return;
  result.focal_length_scale = sum / weights;
  result.focal_length_error = 1 / std::sqrt(weights);
}

std::vector<Speeds> speeds_of(const Comparison& comparison, double delay) {
  std::vector<Speeds> speeds;
  for (const Span& span : comparison.spans()) {
    const double time = span.to - span.from;
    speeds.push_back({span.to - comparison.spans().front().to, span.turn / time, comparison.tracking(span, 0) / time,
                      comparison.tracking(span, delay) / time});
  }
  return speeds;
}

}  // namespace

const char* describe(CannotTell reason) noexcept {
  switch (reason) {
    case CannotTell::no_constants:
      return "there are no constants";
    case CannotTell::other_shape:
      return "the aspect ratio of the pictures differs from that of the constants";
    case CannotTell::too_little:
      return "there is less than two seconds of video with tracking before and after";
    case CannotTell::other_time:
      return "video and tracking have stamps of different times: their clocks differ";
    case CannotTell::hardly_moved:
      return "the camera hardly moved";
    case CannotTell::picture_stood:
      return "tracking moved, but the picture did not, or it had too little detail to be followed";
    case CannotTell::tracking_stood:
      return "the picture moved, but tracking did not";
    case CannotTell::disagree:
      return "the motions of picture and tracking do not match at any delay";
    case CannotTell::too_even:
      return "the camera moved too evenly: pan quickly and stop";
    case CannotTell::out_of_range:
      return "the delay is outside the searched range";
  }
  return "";
}

camera::Result<void> Meter::add(std::int64_t stamp, const wire::CameraParams& params) {
  const auto converted = converter_.convert(params);
  if (!converted.pose) return tl::unexpected(converted.pose.error());
  if (!converted.lens) return tl::unexpected(converted.lens.error());
  if (!samples_.empty() && stamp <= samples_.back().stamp) samples_.clear();
  samples_.push_back({stamp, converted.pose->linear(), *converted.lens});
  return {};
}

void Meter::add(std::int64_t stamp, const cv::Mat& grey) {
  const bool follows = last_frame_ != 0 && stamp > last_frame_;
  if (!follows) frames_.clear();
  const auto& points = motion_.next(grey);
  if (follows) frames_.push_back({last_frame_, stamp, grey.size(), points});
  last_frame_ = stamp;
}

void Meter::keep(double time) {
  const auto kept = static_cast<std::int64_t>(time * 1e9);
  while (!samples_.empty() && samples_.front().stamp < samples_.back().stamp - kept) samples_.pop_front();
  while (!frames_.empty() && frames_.front().before < frames_.back().stamp - kept) frames_.pop_front();
}

std::optional<Turn> Meter::turn_in(const Frame& frame, const camera::Raster& raster, double focal_length_scale) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), frame.stamp,
                                      [](const Sample& sample, std::int64_t stamp) { return sample.stamp < stamp; });
  camera::Lens lens = (after == samples_.end() ? samples_.back() : *after).lens;
  lens.image_distance *= focal_length_scale;
  std::vector<MovedPoint> points = frame.points;
  const auto to_raster = [scale = raster.width / frame.size.width](Eigen::Vector2d& pixel) {
    pixel = ((pixel.array() + 0.5) * scale - 0.5).matrix();
  };
  for (auto& point : points) {
    to_raster(point.before);
    to_raster(point.now);
  }
  auto turn = turn_of(points, lens, raster);
  if (turn) *turn = turn->cwiseProduct(pixels(raster, lens.image_distance));
  return turn;
}

std::vector<Span> Meter::spans_of(const std::vector<const Frame*>& frames, const camera::Raster& raster,
                                  std::size_t length, double focal_length_scale) const {
  const std::int64_t zero = samples_.front().stamp;
  std::vector<Span> spans;
  std::deque<Span> run;  // consecutive frames, `length` at most
  Turn turned = Turn::Zero();
  std::vector<std::optional<Turn>> turns;
  for (const Frame* frame : frames) turns.push_back(turn_in(*frame, raster, focal_length_scale));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Frame* frame = frames[i];
    const auto& turn = turns[i];
    const double from = seconds(frame->before - zero);
    const bool follows = turn && !is_jump(turns, i, raster.width);
    if (!follows || (!run.empty() && run.back().to != from)) {
      run.clear();
      turned.setZero();
    }
    if (!follows) continue;
    run.push_back({from, seconds(frame->stamp - zero), *turn});
    turned += *turn;
    if (run.size() > length) {
      turned -= run.front().turn;
      run.pop_front();
    }
    if (run.size() == length) spans.push_back({run.front().from, run.back().to, turned});
  }
  return spans;
}

Path Meter::tracked_path(const camera::Raster& raster) const {
  Path path;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample &now = samples_[i], &before = samples_[i == 0 ? 0 : i - 1];
    const double image_distance = (before.lens.image_distance + now.lens.image_distance) / 2;
    path.add(seconds(now.stamp - samples_.front().stamp),
             turn_between(before.rotation, now.rotation).cwiseProduct(pixels(raster, image_distance)));
  }
  return path;
}

std::vector<const Meter::Frame*> Meter::frames_within(const Path& path, double& interval) const {
  const std::int64_t zero = samples_.front().stamp;
  // A few steps more than the searched delays, for slopes and parabolas, and the span that ends with a frame.
  const double margin = most_delay_ + 4 * step;
  std::vector<const Frame*> frames;
  std::vector<double> intervals;
  for (const Frame& frame : frames_) {
    const double before = seconds(frame.before - zero), now = seconds(frame.stamp - zero);
    if (now - before > longest_interval) continue;
    intervals.push_back(now - before);
    if (path.covers(before - margin - 2 * span_time, now + margin)) frames.push_back(&frame);
  }
  interval = median(intervals);
  return frames;
}

Measurement Meter::measure() const {
  Measurement result;
  const auto cannot = [&](CannotTell reason) {
    result.cannot_tell = reason;
    return result;
  };
  if (converter_.incoming() == nullptr) return cannot(CannotTell::no_constants);
  if (samples_.empty() || frames_.empty()) return cannot(CannotTell::too_little);
  if (frames_.front().before > samples_.back().stamp || frames_.back().stamp < samples_.front().stamp) {
    return cannot(CannotTell::other_time);
  }
  const camera::Raster raster = camera::raster_of(*converter_.incoming());
  const Path path = tracked_path(raster);
  result.tracking_interval = path.interval();
  const std::vector<const Frame*> frames = frames_within(path, result.frame_interval);
  if (static_cast<double>(frames.size()) * result.frame_interval < least_time) return cannot(CannotTell::too_little);
  const cv::Size size = frames.front()->size;
  if (std::abs(size.width * raster.height / (size.height * raster.width) - 1) > same_shape) {
    return cannot(CannotTell::other_shape);
  }

  const auto length = static_cast<std::size_t>(std::max(1.0, std::round(span_time / result.frame_interval)));
  const Comparison comparison(path, spans_of(frames, raster, length, 1));
  const std::size_t count = comparison.spans().size();
  result.followed = static_cast<double>(count) / static_cast<double>(frames.size());
  const Sums as_stamped = comparison.sums(0);
  const double least = least_speed * raster.width;
  const bool picture_moved = result.followed > 0.5 && speed(as_stamped.picture_squares(), count) > least;
  const bool tracking_moved = speed(as_stamped.tracking_squares(), count) > least;
  if (!tracking_moved) return cannot(picture_moved ? CannotTell::tracking_stood : CannotTell::hardly_moved);
  if (!picture_moved) return cannot(CannotTell::picture_stood);

  find_delay(comparison, result);
  // Spans overlap: only one of `length` is independent.
  const double overlap = std::sqrt(static_cast<double>(length));
  result.accuracy = comparison.accuracy(result.delay, step) * overlap;
  const auto evaluate = [&](const Sums& sums) {
    for (int i = 0; i < 3; ++i) {
      Axis& axis = result.axes[static_cast<std::size_t>(i)];
      axis.scale = sums.scale(i);
      axis.scale_error = sums.scale_error(i) * overlap;
      axis.correlation = sums.correlation(i);
      axis.moved = axis.scale_error < worst_scale_error &&
                   std::sqrt(sums.tracking_squares()[i] / static_cast<double>(count)) / span_time > least / 2;
    }
    find_focal_length(result);
  };
  evaluate(comparison.sums(result.delay));
  // A wrong focal length also distorts the motion away from the centre; so the scales are computed again with the right
  // one.
  if (result.focal_length_scale && result.focal_length_error < worst_focal_length_error) {
    evaluate(Comparison(path, spans_of(frames, raster, length, *result.focal_length_scale)).sums(result.delay));
  }
  result.speeds = speeds_of(comparison, result.delay);
  if (result.correlation < least_correlation) return cannot(CannotTell::disagree);
  if (!(result.accuracy < worst_accuracy)) return cannot(CannotTell::too_even);
  if (std::abs(result.delay) > most_delay_ - step) return cannot(CannotTell::out_of_range);
  return result;
}

void Meter::find_delay(const Comparison& comparison, Measurement& result) const {
  const int steps = static_cast<int>(std::floor(most_delay_ / step));
  std::vector<Sums> tried;
  for (int i = -steps; i <= steps; ++i) tried.push_back(comparison.sums(i * step));
  const auto best = [&](bool also_wrong_signs) {
    const auto highest = std::max_element(tried.begin(), tried.end(), [&](const Sums& a, const Sums& b) {
      return a.explained(also_wrong_signs) < b.explained(also_wrong_signs);
    });
    return comparison.refined(static_cast<double>(highest - tried.begin() - steps) * step, 2 * step, also_wrong_signs);
  };
  const auto left = [&](double delay, bool also_wrong_signs) {
    return 1 - comparison.sums(delay).explained(also_wrong_signs);
  };
  // A periodic motion looks the same with the opposite sign half a period later: wrong signs are accepted only if they
  // leave less than half of the error of right ones.
  const double right = best(false), any = best(true);
  const bool wrong_signs = 2 * left(any, true) < left(right, false);
  result.delay = wrong_signs ? any : right;
  result.correlation = std::sqrt(1 - left(result.delay, wrong_signs));
  for (std::size_t i = 0; i < tried.size(); ++i) {
    result.correlations.push_back(
        {(static_cast<double>(i) - steps) * step, std::sqrt(tried[i].explained(wrong_signs))});
  }
}

}  // namespace trk_bridge::delay
