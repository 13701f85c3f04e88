#include "view.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "text.h"

namespace trk_bridge::monitor {
namespace {

constexpr std::size_t camera_indent = 2;

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

/// Puts items one after the other into lines of a width.
class Flow {
 public:
  explicit Flow(std::size_t width) : width_(width) {}

  /// Lines after the group's first one begin with `indent` spaces.
  void add(const Group& group, std::size_t first_indent, std::size_t indent) {
    begin_line(first_indent);
    indent_ = std::min(indent, width_ / 2);
    for (const auto& item : group.items) add(printable(item.text), item.style, group.gap);
  }
  std::vector<Line> finish() { return std::move(lines_); }

 private:
  void begin_line(std::size_t indent) {
    lines_.emplace_back();
    used_ = 0;
    is_begun_ = false;
    if (indent != 0) put(std::string(std::min(indent, width_ / 2), ' '), Style::plain);
  }

  void put(std::string text, Style style) {
    used_ += text.size();
    lines_.back().push_back({std::move(text), style});
  }

  void add(std::string_view text, Style style, std::size_t gap) {
    if (is_begun_ && used_ + gap + text.size() <= width_) {
      put(std::string(gap, ' '), Style::plain);
    } else if (is_begun_) {
      begin_line(indent_);
    }
    while (used_ + text.size() > width_) {
      const std::size_t room = width_ - used_;
      const std::size_t space = text.substr(0, room + 1).rfind(' ');
      const bool has_space = space != std::string_view::npos && space != 0;
      put(std::string(text.substr(0, has_space ? space : room)), style);
      text.remove_prefix(has_space ? space + 1 : room);
      begin_line(indent_);
    }
    put(std::string(text), style);
    is_begun_ = true;
  }

  std::size_t width_, indent_ = 0, used_ = 0;
  bool is_begun_ = false;
  std::vector<Line> lines_;
};

std::vector<Line> lines_of(const CameraState& camera, std::size_t width) {
  Flow flow(width);
  std::size_t indent = 0;
  for (const auto& group : groups_of(camera)) {
    flow.add(group, indent, 2 * camera_indent);
    indent = camera_indent;
  }
  return flow.finish();
}

std::vector<Line> lines_of(const State& state, std::size_t width) {
  Flow flow(width);
  auto groups = groups_of(state);
  groups.front().items.push_back({"q: quit", Style::faint});
  for (const auto& group : groups) flow.add(group, 0, camera_indent);
  return flow.finish();
}

/// Every camera's lines within `room`; blank lines between them where there is room for all.
void add_cameras(const State& state, std::size_t width, std::size_t room, std::vector<Line>& screen) {
  std::vector<std::vector<Line>> blocks;
  std::size_t wanted = 0;
  for (const auto& camera : state.cameras) {
    blocks.push_back(lines_of(camera, width));
    wanted += blocks.back().size();
  }
  const bool has_gaps = wanted + blocks.size() <= room;
  // With more cameras than lines the last line says how many there are besides.
  const std::size_t shown = blocks.size() <= room ? blocks.size() : room - 1;
  std::size_t left = room - (shown < blocks.size() ? 1 : 0);
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t share = has_gaps ? blocks[i].size() : std::min(blocks[i].size(), left / (shown - i));
    if (has_gaps) screen.emplace_back();
    std::move(blocks[i].begin(), blocks[i].begin() + static_cast<std::ptrdiff_t>(share), std::back_inserter(screen));
    left -= std::min(left, share);
  }
  if (shown == blocks.size()) return;
  Flow flow(width);
  flow.add({{{std::to_string(blocks.size() - shown) + " more", Style::warning}}}, 0, 0);
  screen.push_back(flow.finish().front());
}

std::string joined(const std::vector<Group>& groups) {
  std::string line;
  for (const auto& group : groups) {
    for (const auto& item : group.items) {
      if (!line.empty()) line += "  ";
      line += printable(item.text);
    }
  }
  return line;
}

}  // namespace

std::vector<Line> screen_of(const State& state, Size size) {
  if (size.width == 0 || size.height == 0) return {};
  auto screen = lines_of(state, size.width);
  if (!state.cameras.empty()) screen.resize(std::min(screen.size(), std::max<std::size_t>(1, size.height / 3)));
  if (screen.size() < size.height && !state.cameras.empty()) {
    add_cameras(state, size.width, size.height - screen.size(), screen);
  }
  if (screen.size() > size.height) screen.resize(size.height);
  return screen;
}

std::vector<std::string> plain_lines_of(const State& state, double period) {
  std::vector<std::string> lines;
  const bool is_new_fault = state.malformed && state.malformed->age < period;
  if (state.cameras.empty() || is_new_fault) lines.push_back(joined(groups_of(state)));
  for (const auto& camera : state.cameras) lines.push_back(joined(groups_of(camera)));
  return lines;
}

}  // namespace trk_bridge::monitor
