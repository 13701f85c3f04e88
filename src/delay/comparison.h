// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Compares the turns of the picture with those of tracking at different delays of tracking.
#pragma once

#include <vector>

#include "turn.h"

namespace trk_bridge::delay {

/// How far tracking has turned since its first sample, over time (s). Here and below, turns have any unit that is the
/// same for picture and tracking.
class Path {
 public:
  /// Adds a sample that is later than the last one, and how far it has turned since that.
  void add(double time, const Turn& turn);
  /// Whether between() can be called for all times in this range: there are samples without gaps, and one more on both
  /// sides.
  bool covers(double from, double to) const;
  Turn between(double from, double to) const { return at(to) - at(from); }
  /// The median interval of samples, s.
  double interval() const;

 private:
  Turn at(double time) const;

  std::vector<double> times_;
  std::vector<Turn> turned_;
};

/// How far the picture turned from one frame to a later one; stamps in s.
struct Span {
  double from, to;
  Turn turn;
};

/// Sums over spans for each axis.
class Sums {
 public:
  void add(const Turn& picture, const Turn& tracking);

  double scale(int axis) const;        ///< turn of the picture divided by turn of tracking
  double scale_error(int axis) const;  ///< its standard deviation for independent spans
  double correlation(int axis) const;  ///< -1 to 1
  /// The share of the picture's motion that tracking explains, with one scale per axis; 0 to 1.
  double explained(bool also_wrong_signs) const;
  const Turn& picture_squares() const { return picture_; }
  const Turn& tracking_squares() const { return tracking_; }

 private:
  Turn mixed_ = Turn::Zero(), picture_ = Turn::Zero(), tracking_ = Turn::Zero();
  double count_ = 0;
};

/// Spans, and a path that covers them for all requested delays. The path must outlive this object.
class Comparison {
 public:
  Comparison(const Path& path, std::vector<Span> spans) : path_(path), spans_(std::move(spans)) {}

  const std::vector<Span>& spans() const { return spans_; }
  Turn tracking(const Span& span, double delay) const { return path_.between(span.from - delay, span.to - delay); }
  Sums sums(double delay) const;
  /// The delay near `delay` with the largest explained share, from parabolas through it and its neighbours at distance
  /// `step`.
  double refined(double delay, double step, bool also_wrong_signs) const;
  /// Standard deviation of a delay for independent spans, s: the unexplained motion of the picture relative to its
  /// change with the delay.
  double accuracy(double delay, double step) const;

 private:
  const Path& path_;
  std::vector<Span> spans_;
};

}  // namespace trk_bridge::delay
