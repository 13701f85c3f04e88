// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "view.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "chart.h"
#include "text.h"

namespace trk_bridge::monitor {
namespace {

constexpr std::size_t indent = 2;
// A cell has its label on the left, the value ends at a fixed column, and the unit follows.
constexpr std::size_t cell_width = 19, value_end = 14;
constexpr std::size_t columns_for_rows = 4;  // with fewer columns, groups do not begin new lines
constexpr std::size_t most_columns = 6;
constexpr std::size_t column_gap = 2;
constexpr std::size_t fewest_rows_with_keys = 6;
constexpr std::size_t plot_rows = 7, fewest_plot_rows = 5, most_plots = 4;  // with its title
constexpr std::size_t histogram_width = 32, fewest_columns_with_histogram = 72;

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::string in_columns(const Cell& cell) {
  std::string text = cell.label;
  if (!cell.value.empty()) {
    const std::size_t used = text.size() + cell.value.size();
    text += std::string(used < value_end ? value_end - used : (text.empty() ? 0 : 1), ' ') + cell.value;
  }
  return cell.unit.empty() ? text : text + " " + cell.unit;
}

/// Lines with a width, filled from the left.
class Lines {
 public:
  explicit Lines(std::size_t width) : width_(width) {}

  /// Begins a line. Text that does not fit continues in the next line after `hanging` spaces.
  void begin(std::size_t indentation, std::size_t hanging) {
    hanging_ = std::min(hanging, width_ / 2);
    begin_line(std::min(indentation, width_ / 2));
  }
  /// Appends to the line.
  void flow(const std::string& text, Style style) {
    add(printable(text), style, is_begun_ ? used_ + column_gap : used_);
  }
  /// Appends in the next column.
  void cell(const Cell& cell) {
    const std::size_t begun = used_ - begin_ + (is_begun_ ? 1 : 0);
    add(printable(in_columns(cell)), cell.style, begin_ + (begun + cell_width - 1) / cell_width * cell_width);
  }
  /// Free columns in this line, and all columns of a line.
  std::size_t columns_left() const {
    const std::size_t used = (used_ - begin_ + cell_width - 1) / cell_width;
    return used > columns() ? 0 : columns() - used;
  }
  std::size_t columns() const { return std::min((width_ - std::min(width_, begin_) + 1) / cell_width, most_columns); }
  std::size_t size() const { return lines_.size(); }
  std::vector<Line> finish() { return std::move(lines_); }

 private:
  void begin_line(std::size_t indentation) {
    lines_.emplace_back();
    begin_ = indentation;
    used_ = 0;
    is_begun_ = false;
    pad_to(indentation);
  }
  void pad_to(std::size_t column) {
    if (column > used_) put(std::string(column - used_, ' '), Style::plain);
  }
  void put(std::string text, Style style) {
    used_ += text.size();
    lines_.back().push_back({std::move(text), style});
  }
  void add(std::string_view text, Style style, std::size_t column) {
    if (is_begun_ && column + text.size() > width_) {
      begin_line(hanging_);
    } else {
      pad_to(std::min(column, width_));
    }
    while (used_ + text.size() > width_) {
      const std::size_t room = width_ - used_;
      const std::size_t space = text.substr(0, room + 1).rfind(' ');
      const bool has_space = space != std::string_view::npos && space != 0;
      put(std::string(text.substr(0, has_space ? space : room)), style);
      text.remove_prefix(has_space ? space + 1 : room);
      begin_line(hanging_);
    }
    put(std::string(text), style);
    is_begun_ = true;
  }

  std::size_t width_, hanging_ = 0, begin_ = 0, used_ = 0;
  bool is_begun_ = false;
  std::vector<Line> lines_;
};

/// Lines, and the group of each.
struct Block {
  std::vector<Line> lines;
  std::vector<std::string> groups;

  /// Keeps only the first `rows`. Returns the names of the groups that lost lines.
  std::vector<std::string> cut(std::size_t rows) {
    std::vector<std::string> missing;
    for (std::size_t i = rows; i < lines.size(); ++i) {
      if (missing.empty() || missing.back() != groups[i]) missing.push_back(groups[i]);
    }
    if (lines.size() > rows) lines.resize(rows);
    return missing;
  }
};

Block block_of(const CameraState& camera, std::size_t width, bool is_one_of_several) {
  Lines lines(width);
  Block block;
  const auto groups = groups_of(camera);
  lines.begin(0, indent);
  std::string mark = is_one_of_several ? "> " : "";
  for (const auto& cell : groups.front().cells) lines.flow(std::exchange(mark, "") + to_string(cell), cell.style);
  block.groups.resize(lines.size(), groups.front().name);
  lines.begin(indent, indent);
  for (std::size_t i = 1; i < groups.size(); ++i) {
    const auto& cells = groups[i].cells;
    const bool is_words = !cells.empty() && cells.front().value.empty();
    const bool joins = lines.columns() < columns_for_rows || (cells.size() <= lines.columns_left() && !is_words);
    if (!joins) lines.begin(indent, indent);
    for (const auto& cell : cells) lines.cell(cell);
    block.groups.resize(lines.size(), groups[i].name);
  }
  block.lines = lines.finish();
  return block;
}

Line summary_line(const CameraState& camera, std::size_t width) {
  Lines lines(width);
  lines.begin(indent, indent);
  for (const auto& cell : summary_of(camera)) lines.cell(cell);
  return lines.finish().front();
}

std::vector<Line> head_of(const State& state, const Choice& choice, std::size_t width) {
  Lines lines(width);
  lines.begin(0, indent);
  lines.flow("trk monitor", Style::heading);
  if (choice.is_paused) lines.flow("PAUSED", Style::warning);
  const auto what = state_of(state.source);
  lines.flow(what.label, what.style);
  for (const auto& cell : counts_of(state)) lines.flow(to_string(cell), cell.style);
  if (!choice.notice.empty()) {
    lines.begin(0, indent);
    lines.flow(choice.notice, Style::heading);
  }
  return lines.finish();
}

Style style_of(const bridge::Finding& finding) {
  if (finding.level == bridge::Level::ok) return Style::plain;
  return finding.level == bridge::Level::error ? Style::error : Style::warning;
}

std::vector<Line> findings_of(const State& state, const Choice& choice, std::size_t width) {
  Lines lines(width);
  for (const auto& text : choice.guide) {
    lines.begin(0, indent);
    lines.flow(text, Style::heading);
  }
  if (!choice.guide.empty()) return lines.finish();
  for (const auto& finding : state.findings) {
    lines.begin(0, indent);
    lines.flow((finding.level == bridge::Level::ok ? "- " : "! ") + finding.text, style_of(finding));
  }
  lines.begin(0, indent);
  for (const auto& cell : malformed_of(state)) lines.flow(to_string(cell), cell.style);
  auto finished = lines.finish();
  if (!state.malformed) finished.pop_back();
  return finished;
}

Line keys_line(std::size_t width, bool has_guide) {
  Lines lines(width);
  lines.begin(0, 0);
  if (has_guide) lines.flow("space: next step  a: end", Style::heading);
  for (const char* key : {"?: help", "q: quit", "p: pause", "r: reset", "n: next camera", "v: value", "t: time",
                          "R: record", "a: axis check"}) {
    lines.flow(key, Style::plain);
  }
  return lines.finish().front();
}

Line text_line(std::string text, Style style = Style::plain) { return {{std::move(text), style}}; }

std::string fitted(std::string text, std::size_t width) {
  text.resize(width, ' ');
  return text;
}

/// `rows` lines: plots, and beside them the histogram.
std::vector<Line> charts(const CameraState& camera, const Choice& choice, std::size_t width, std::size_t rows) {
  const bool has_histogram = width >= fewest_columns_with_histogram;
  const std::size_t left = has_histogram ? width - histogram_width - column_gap : width;
  const std::size_t plots = std::clamp<std::size_t>(rows / plot_rows, 1, most_plots);
  const auto span = static_cast<std::int64_t>(choice.seconds) * 1'000'000'000;
  const auto end = camera.history->newest() + static_cast<std::int64_t>(camera.latest->age * 1e9);

  std::vector<std::string> text;
  std::vector<std::size_t> titles;
  for (std::size_t i = 0; i < plots; ++i) {
    titles.push_back(text.size());
    const auto value = static_cast<Value>((static_cast<std::size_t>(choice.plotted) + i) % value_count);
    const auto& [name, unit, decimals, least_range] = text_of(value);
    const std::size_t share = (rows - text.size()) / (plots - i);
    text.push_back(std::string(name) + (*unit == '\0' ? "" : std::string(" (") + unit + ")") + ", last " +
                   std::to_string(choice.seconds) + " s");
    const std::size_t columns = left > scale_width ? left - scale_width : 0;
    for (auto& line : curve(camera.history->columns(value, end, span, columns), share - 1, decimals, least_range)) {
      text.push_back(std::move(line));
    }
  }
  std::vector<std::string> bars{"intervals, last 10 s"};
  for (auto& line : histogram(camera.intervals, rows - 1, histogram_width)) bars.push_back(std::move(line));
  std::vector<Line> lines;
  for (std::size_t row = 0; row < rows; ++row) {
    std::string line = fitted(row < text.size() ? text[row] : "", left);
    if (has_histogram && row < bars.size()) line += std::string(column_gap, ' ') + bars[row];
    const bool is_title = std::find(titles.begin(), titles.end(), row) != titles.end();
    const std::size_t bold = is_title ? std::min(left, width) : 0;
    lines.push_back({{line.substr(0, bold), Style::heading}, {line.substr(bold, width - bold), Style::plain}});
  }
  return lines;
}

std::string plural(std::size_t count, const std::string& what) {
  return std::to_string(count) + " more " + what + (count == 1 ? "" : "s");
}

/// A list of names; if it does not fit, ends with the number of the others.
std::string listed(const std::vector<std::string>& names, std::size_t width) {
  for (std::size_t count = names.size(); count > 0; --count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + names[i];
    if (count < names.size()) text += ", +" + std::to_string(names.size() - count);
    if (text.size() <= width) return text;
  }
  return std::to_string(names.size()) + " parts";
}

std::string joined(const std::vector<Cell>& cells) {
  std::string line;
  for (const auto& cell : cells) line += (line.empty() ? "" : "  ") + printable(to_string(cell));
  return line;
}

void append(std::vector<Line>& to, std::vector<Line> lines) {
  std::move(lines.begin(), lines.end(), std::back_inserter(to));
}

/// Appends the chosen camera, the others and the charts to the screen. Leaves one line for the names of hidden parts.
void add_cameras(const State& state, const Choice& choice, Size size, std::vector<Line>& screen,
                 std::vector<std::string>& hidden) {
  const std::size_t at = chosen(state, choice);
  const auto& camera = state.cameras[at];
  const std::size_t others = state.cameras.size() - 1;
  auto block = block_of(camera, size.width, others > 0);

  const bool has_histogram = size.width >= fewest_columns_with_histogram;
  const std::size_t room = size.height - screen.size();
  const bool has_room_for_all =
      hidden.empty() && has_histogram && block.lines.size() + others + fewest_plot_rows <= room;
  const std::size_t usable = has_room_for_all ? room : room - 1;
  const std::size_t shown_others =
      std::min(others, std::max(usable / 3, usable - std::min(usable, block.lines.size())));
  for (auto& name : block.cut(usable - shown_others)) hidden.push_back(std::move(name));
  append(screen, std::move(block.lines));
  for (std::size_t i = 0, shown = 0; shown < shown_others; ++i) {
    if (i == at) continue;
    screen.push_back(summary_line(state.cameras[i], size.width));
    ++shown;
  }
  if (shown_others < others) hidden.push_back(plural(others - shown_others, "camera"));

  if (!camera.latest || !camera.history) return;
  const std::size_t left = size.height - screen.size() - (has_room_for_all ? 0 : 1);
  if (left < fewest_plot_rows) {
    hidden.emplace_back("plots");
    return;
  }
  append(screen, charts(camera, choice, size.width, left));
  if (!has_histogram) hidden.emplace_back("histogram");
}

}  // namespace

std::size_t chosen(const State& state, const Choice& choice) {
  const cli::Tally::Less less;
  for (std::size_t i = 0; choice.camera && i < state.cameras.size(); ++i) {
    const auto& key = state.cameras[i].key;
    if (!less(key, *choice.camera) && !less(*choice.camera, key)) return i;
  }
  return 0;
}

std::vector<Line> screen_of(const State& state, const Choice& choice, Size size) {
  if (size.width == 0 || size.height == 0) return {};
  std::vector<std::string> hidden;
  auto screen = head_of(state, choice, size.width);
  screen.resize(std::min(screen.size(), std::max<std::size_t>(1, size.height / 5)));
  auto findings = findings_of(state, choice, size.width);
  const std::size_t for_findings =
      choice.guide.empty() ? std::max<std::size_t>(2, size.height / 4) : size.height - screen.size();
  if (findings.size() > for_findings) {
    findings.resize(for_findings);
    hidden.emplace_back("findings");
  }
  append(screen, std::move(findings));

  const std::size_t last = size.height - (size.height < fewest_rows_with_keys ? 0 : 1);
  if (!state.cameras.empty() && screen.size() < last) add_cameras(state, choice, {size.width, last}, screen, hidden);
  if (!hidden.empty() && screen.size() < last) {
    screen.resize(last - 1);
    const std::string text = "hidden: " + listed(hidden, size.width - std::min<std::size_t>(size.width, 8));
    screen.push_back(text_line(text.substr(0, size.width), Style::heading));
  }
  screen.resize(last < size.height ? last : std::min(screen.size(), last));
  if (last < size.height) screen.push_back(keys_line(size.width, !choice.guide.empty()));
  return screen;
}

std::vector<Line> help_screen(Size size) {
  // The first eight lines, of at most 40 characters, explain the keys.
  static constexpr const char* texts[] = {
      "?  help           q  quit",
      "p  pause          r  reset",
      "n  next camera    N  previous camera",
      "v  next plot      V  previous plot",
      "t  plots of 10, 30 or 60 s",
      "R  record a take; again: end it",
      "a  axis check; space: its next step",
      "Any key goes back.",
      "",
      "Lines with ! need attention; the first one is the most important.",
      "The line above the keys names what does not fit in this terminal.",
      "Pause: the screen stays unchanged; records are still received, and recorded.",
      "Reset: counts, findings and plots start from zero.",
      "Position: x to the right wall, y to the back wall, z up, studio frame.",
      "Angles: pan to the left, tilt upwards, roll clockwise as the operator sees it.",
      "lens: image distance. fov h: horizontal field of view without distortion.",
      "jitter, p99, worst: difference of intervals from the median interval.",
      "noise: standard deviation while the camera is at rest.",
  };
  Lines lines(size.width);
  if (size.width == 0) return {};
  for (const char* text : texts) {
    lines.begin(0, 3);
    lines.flow(text, Style::plain);
  }
  auto all = lines.finish();
  if (all.size() > size.height) {
    all.resize(size.height);
    if (size.height > 8) all.back() = text_line(std::string("hidden: more help").substr(0, size.width), Style::heading);
  }
  return all;
}

std::vector<std::string> plain_lines_of(const State& state, double period) {
  std::vector<std::string> lines;
  for (const auto& finding : state.findings) {
    if (finding.level != bridge::Level::ok) lines.push_back("! " + printable(finding.text));
  }
  const bool is_new_fault = state.malformed && state.malformed->age < period;
  if (state.cameras.empty() || is_new_fault) {
    auto cells = counts_of(state);
    cells.insert(cells.begin(), state_of(state.source));
    for (auto& cell : malformed_of(state)) cells.push_back(cell);
    lines.push_back("trk monitor  " + joined(cells));
  }
  for (const auto& camera : state.cameras) {
    std::vector<Cell> cells;
    for (const auto& group : groups_of(camera)) cells.insert(cells.end(), group.cells.begin(), group.cells.end());
    lines.push_back(joined(cells));
  }
  return lines;
}

}  // namespace trk_bridge::monitor
