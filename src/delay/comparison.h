// What the picture turned against what tracking turned, as if tracking were delayed.
#pragma once

#include <vector>

#include "turn.h"

namespace trk_bridge::delay {

/// How far tracking has turned since its first sample, over time (s). Any unit of turns, here and below, that is the
/// same for picture and tracking.
class Path {
 public:
  /// The next sample, later than the last, and how far it turned since that.
  void add(double time, const Turn& turn);
  /// Whether between() can be asked for any times between these: there are samples all the way, and one more to both
  /// sides.
  bool covers(double from, double to) const;
  Turn between(double from, double to) const { return at(to) - at(from); }
  /// Of samples, s: the median.
  double interval() const;

 private:
  Turn at(double time) const;

  std::vector<double> times_;
  std::vector<Turn> turned_;
};

/// How far the picture turned from one frame to a later one, stamps in s.
struct Span {
  double from, to;
  Turn turn;
};

/// Sums over spans, an axis each.
class Sums {
 public:
  void add(const Turn& picture, const Turn& tracking);

  double scale(int axis) const;        ///< the picture's turn over tracking's
  double scale_error(int axis) const;  ///< its standard deviation, if all spans were independent
  double correlation(int axis) const;  ///< -1 to 1
  /// The part of the picture's motion that tracking accounts for with a scale for each axis, 0 to 1.
  double explained(bool also_wrong_signs) const;
  const Turn& picture_squares() const { return picture_; }
  const Turn& tracking_squares() const { return tracking_; }

 private:
  Turn mixed_ = Turn::Zero(), picture_ = Turn::Zero(), tracking_ = Turn::Zero();
  double count_ = 0;
};

/// Spans and a path that covers them for all delays that are asked for. The path must outlive this.
class Comparison {
 public:
  Comparison(const Path& path, std::vector<Span> spans) : path_(path), spans_(std::move(spans)) {}

  const std::vector<Span>& spans() const { return spans_; }
  Turn tracking(const Span& span, double delay) const { return path_.between(span.from - delay, span.to - delay); }
  Sums sums(double delay) const;
  /// The delay near `delay` with the highest explained part, by parabolas through it and both at `step` beside it.
  double refined(double delay, double step, bool also_wrong_signs) const;
  /// Standard deviation of a delay, s, if all spans were independent: what tracking leaves of the picture's motion
  /// against how much a delay changes that.
  double accuracy(double delay, double step) const;

 private:
  const Path& path_;
  std::vector<Span> spans_;
};

}  // namespace trk_bridge::delay
