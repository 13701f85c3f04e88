// The words and numbers of the monitor, in groups, before they are laid out.
#pragma once

#include <string>
#include <vector>

#include "view.h"

namespace trk_bridge::monitor {

/// A number with its label and unit, or words in `label` alone. They are never separated by the end of a line.
struct Cell {
  std::string label, value, unit;
  Style style = Style::plain;
};
/// "pan 30.000 deg"
std::string to_string(const Cell&);

/// What belongs together, and its name where it has to be left out.
struct Group {
  std::string name;
  std::vector<Cell> cells;
};

/// "receiving", "waiting for slot 7: no segment"
Cell state_of(const transport::SourceStatistics&);
/// Counts of the source; its name last.
std::vector<Cell> counts_of(const State&);
/// The last malformed record; nothing where there was none.
std::vector<Cell> malformed_of(const State&);
/// What matters most first.
std::vector<Group> groups_of(const CameraState&);
/// One line of a camera among others.
std::vector<Cell> summary_of(const CameraState&);
/// "at rest", "moving", "noise -" where it is not known.
std::string motion_of(const CameraState&);

/// With a fixed number of decimals and no -0; in the form 1e+10 when it is large.
std::string fixed(double value, int decimals);

/// The name and unit of what is plotted, and the smallest range that a plot shows.
struct ValueText {
  const char* name;
  const char* unit;
  int decimals;
  double least_range;
};
const ValueText& text_of(Value);

}  // namespace trk_bridge::monitor
