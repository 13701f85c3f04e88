// How much a camera that stands still seems to move.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace trk_bridge::monitor {

/// x, y, z in metres, pan, tilt, roll in degrees.
using PoseNumbers = std::array<double, 6>;

enum class Motion : std::uint8_t {
  unknown,  ///< not enough poses within the window
  moving,
  still,
};

struct Rest {
  Motion motion = Motion::unknown;
  PoseNumbers deviation{};  ///< standard deviation of each number when still
};

/// The poses of one camera within the last three seconds. Not synchronised.
///
/// The camera stands still when, of each number, the range is at most `most_range` and the means of the older and the
/// newer half of the window are at most `most_drift` apart. The range lets the noise of any tracker through; the means
/// show a slow move, whose halves differ by half its way while those of noise agree. Needs twenty poses that span nine
/// tenths of the window.
class RestWindow {
 public:
  /// `arrival` in nanoseconds; one before the last starts the window again.
  void add(std::int64_t arrival, const PoseNumbers&);
  Rest judge() const;

  static constexpr std::int64_t length = 3'000'000'000;  ///< ns
  static constexpr std::size_t most = 3000, fewest = 20;
  static constexpr PoseNumbers most_range{0.01, 0.01, 0.01, 0.2, 0.2, 0.2};
  static constexpr PoseNumbers most_drift{0.0005, 0.0005, 0.0005, 0.01, 0.01, 0.01};

 private:
  struct Entry {
    std::int64_t arrival;
    PoseNumbers pose;
  };
  /// Number `i` of entry `n` from the first one's; angles the short way round.
  double offset(std::size_t n, std::size_t i) const;
  bool is_still(std::size_t i) const;
  double deviation(std::size_t i) const;
  double mean(std::size_t i, std::size_t begin, std::size_t end) const;

  std::deque<Entry> entries_;
};

}  // namespace trk_bridge::monitor
