// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Detects counters that are time codes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace trk_bridge::monitor {

/// Some trackers send a time code instead of a count: as decimal digits HHMMSSFF, as binary coded decimals, with one
/// byte per part, or only its frame number. Such a counter jumps or restarts every second, which is not a loss.
/// Detected after two seconds. Not synchronised, does not allocate.
class TimeCodeCounter {
 public:
  void add(std::uint64_t counter) noexcept;

  /// "10:20:30:12 as decimal digits"; none if it is not a time code, or not detected yet.
  std::optional<std::string> description() const;

  /// A counter decoded as time code.
  struct Code {
    std::int64_t second = 0;  ///< of the day; always 0 if only the frame is sent
    int frame = 0;
  };

 private:
  struct Guess {
    std::optional<Code> last;
    int length = 0;   // frames per second, if only the frame is sent
    int seconds = 0;  // consecutive seconds that began as expected
  };

  std::array<Guess, 4> guesses_;
};

}  // namespace trk_bridge::monitor
