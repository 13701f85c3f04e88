// `trk monitor` as text: the model's state laid out for a width and a height, or a line a camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model.h"

namespace trk_bridge::monitor {

enum class Style : std::uint8_t { plain, heading, faint, warning, error };

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

/// At most `height` lines of at most `width` characters. The source comes first, in a third of them where cameras
/// follow, then the cameras, all with the same share of the lines that are left and what matters most first in it:
/// where there is no room, the rest is left out, and the number of cameras left out is shown.
std::vector<Line> screen_of(const State&, Size);

/// A line a camera with everything that is known of it; before them one about the source when there is no camera yet
/// or a malformed record came within the last `period` seconds.
std::vector<std::string> plain_lines_of(const State&, double period);

}  // namespace trk_bridge::monitor
