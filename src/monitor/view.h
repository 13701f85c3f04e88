// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk monitor` as text: the state of the model laid out for a screen, or as one line per camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model.h"

namespace trk_bridge::monitor {

enum class Style : std::uint8_t { plain, heading, warning, error };

/// Printable ASCII only: other characters in a name are shown as question marks.
struct Span {
  std::string text;
  Style style = Style::plain;
};
using Line = std::vector<Span>;

/// Columns and rows.
struct Size {
  std::size_t width = 0, height = 0;
};

/// What the user has chosen with keys.
struct Choice {
  std::optional<cli::Tally::Key> camera;  ///< the camera that is shown in full; none or not present: the first
  Value plotted = Value::pan;             ///< if there is room for more plots, the following ones, too
  int seconds = 10;                       ///< time span of plots
  bool is_paused = false;
  std::string notice;              ///< one line about the effect of the last key
  std::vector<std::string> guide;  ///< lines of the axis check, shown instead of the findings; empty: it is off
};

/// The index of the chosen camera; 0 if it is not present.
std::size_t chosen(const State&, const Choice&);

/// At most `height` lines of at most `width` characters: the source; findings; the chosen camera in columns, the most
/// important values first; the other cameras, one line each; if there is room, plots and a histogram of intervals;
/// keys. The line above the keys names what does not fit.
std::vector<Line> screen_of(const State&, const Choice&, Size);
/// Explains keys and words.
std::vector<Line> help_screen(Size);

/// One line for each finding that is not ok; one about the source if there is no camera yet, or if a malformed record
/// was received within the last `period` seconds; then one line for each camera with all its data.
std::vector<std::string> plain_lines_of(const State&, double period);

}  // namespace trk_bridge::monitor
