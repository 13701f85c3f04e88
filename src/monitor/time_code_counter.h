// Whether a counter is a time code in disguise.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace trk_bridge::monitor {

/// Some trackers send a time code in place of a count: as decimal digits HHMMSSFF, as binary coded decimals, with a
/// byte for each part, or its frame number alone. Such a counter jumps or begins again with every second, which is no
/// loss. Found after two seconds of the code. Not synchronised, never allocates.
class TimeCodeCounter {
 public:
  void add(std::uint64_t counter) noexcept;

  /// "10:20:30:12 as decimal digits"; none where it is not a time code, or not known yet.
  std::optional<std::string> description() const;

  /// What one way of writing a time code makes of a counter.
  struct Code {
    std::int64_t second = 0;  ///< of the day; always 0 where only the frame is written
    int frame = 0;
  };

 private:
  struct Guess {
    std::optional<Code> last;
    int length = 0;   // frames of a second, where only the frame is written
    int seconds = 0;  // that have begun as they should, in a row
  };

  std::array<Guess, 4> guesses_;
};

}  // namespace trk_bridge::monitor
