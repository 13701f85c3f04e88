// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures the noise of the pose of a camera at rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace trk_bridge::monitor {

/// x, y, z in metres, pan, tilt, roll in degrees.
using PoseNumbers = std::array<double, 6>;
/// The numbers before it are lengths.
inline constexpr std::size_t first_angle = 3;

enum class Motion : std::uint8_t {
  unknown,  ///< too few poses within the window
  moving,
  still,
};

struct Rest {
  Motion motion = Motion::unknown;
  PoseNumbers deviation{};  ///< standard deviation of each number when still
};

/// The poses of one camera within the last three seconds. Not synchronised.
///
/// The camera is at rest if, for each number, the range is at most `most_range` and the means of the older and the
/// newer half of the window differ by at most `most_drift`. The limit of the range is above the noise of any tracker.
/// The means detect a slow motion: its halves differ by half its distance, while those of noise agree. Needs twenty
/// poses that cover 90 % of the window.
class RestWindow {
 public:
  /// `arrival` in nanoseconds; if it is before the last one, the window is cleared.
  void add(std::int64_t arrival, const PoseNumbers&);
  Rest classify() const;

  static constexpr std::int64_t length = 3'000'000'000;  ///< ns
  static constexpr std::size_t most = 3000, fewest = 20;
  static constexpr PoseNumbers most_range{0.01, 0.01, 0.01, 0.2, 0.2, 0.2};
  static constexpr PoseNumbers most_drift{0.0005, 0.0005, 0.0005, 0.01, 0.01, 0.01};

 private:
  struct Entry {
    std::int64_t arrival;
    PoseNumbers pose;
  };
  /// Difference of number `i` between entry `n` and the first entry; for angles the smallest one.
  double offset(std::size_t n, std::size_t i) const;
  bool is_still(std::size_t i) const;
  double deviation(std::size_t i) const;
  double mean(std::size_t i, std::size_t begin, std::size_t end) const;

  std::deque<Entry> entries_;
};

}  // namespace trk_bridge::monitor
