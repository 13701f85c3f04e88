// `trk monitor` as text: the model's state laid out for a width and a height, or a line a camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model.h"

namespace trk_bridge::monitor {

enum class Style : std::uint8_t { plain, heading, warning, error };

/// Printable ASCII: whatever else came in a name is shown as a question mark.
struct Span {
  std::string text;
  Style style = Style::plain;
};
using Line = std::vector<Span>;

/// Columns and rows.
struct Size {
  std::size_t width = 0, height = 0;
};

/// What the user has chosen to see.
struct Choice {
  std::optional<cli::Tally::Key> camera;  ///< the one that is shown in full; none, or gone: the first
  Value plotted = Value::pan;             ///< where there is room for more plots, those after it, too
  int seconds = 10;                       ///< that plots show
  bool is_paused = false;
  std::string notice;              ///< one line about what the last key did
  std::vector<std::string> guide;  ///< of the axis check, in place of the findings; empty: it is off
};

/// The index of the camera of the choice; 0 where it is none of them.
std::size_t chosen(const State&, const Choice&);

/// At most `height` lines of at most `width` characters: the source; findings; the chosen camera with labels and values
/// in columns, what matters most first; the other cameras, a line each; where there is room plots and a histogram of
/// intervals; keys. What has no room is named in the line above the keys.
std::vector<Line> screen_of(const State&, const Choice&, Size);
/// What the keys do and what the words mean.
std::vector<Line> help_screen(Size);

/// A line for each finding that is not ok; one about the source when there is no camera yet or a malformed record came
/// within the last `period` seconds; then a line for each camera with everything that is known of it.
std::vector<std::string> plain_lines_of(const State&, double period);

}  // namespace trk_bridge::monitor
