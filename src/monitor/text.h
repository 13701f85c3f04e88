// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The text of the monitor in groups, before layout.
#pragma once

#include <string>
#include <vector>

#include "view.h"

namespace trk_bridge::monitor {

/// A number with its label and unit, or only text in `label`. A cell is never split between lines.
struct Cell {
  std::string label, value, unit;
  Style style = Style::plain;
};
/// "pan 30.000 deg"
std::string to_string(const Cell&);

/// Cells that belong together; the name is shown if the group does not fit.
struct Group {
  std::string name;
  std::vector<Cell> cells;
};

/// "receiving", "waiting"
Cell state_of(const transport::SourceStatistics&);
/// Counts of the source, then its name.
std::vector<Cell> counts_of(const State&);
/// The last malformed record; empty if there was none.
std::vector<Cell> malformed_of(const State&);
/// The most important group first.
std::vector<Group> groups_of(const CameraState&);
/// A summary of a camera in one line.
std::vector<Cell> summary_of(const CameraState&);
/// "at rest", "moving", or "noise -" if unknown.
std::string motion_of(const CameraState&);

/// With a fixed number of decimals and no -0; large numbers as 1e+10.
std::string fixed(double value, int decimals);

/// Name and unit of a plotted value, and the smallest range of its plot.
struct ValueText {
  const char* name;
  const char* unit;
  int decimals;
  double least_range;
};
const ValueText& text_of(Value);

}  // namespace trk_bridge::monitor
