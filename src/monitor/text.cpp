// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "text.h"

#include <array>
#include <cmath>

#include "base/number_text.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::monitor {
namespace {

std::string fixed_milliseconds(std::int64_t nanoseconds) { return fixed(static_cast<double>(nanoseconds) * 1e-6, 3); }

std::string seconds(double value) { return fixed(value, value < 10 ? 2 : 0); }

Cell words(std::string text, Style style = Style::plain) { return {std::move(text), "", "", style}; }

/// A count that should be 0.
Cell error_count(const char* what, std::uint64_t count) {
  return {what, std::to_string(count), "", count == 0 ? Style::plain : Style::warning};
}

void add_if_any(std::vector<Cell>& cells, const char* what, std::uint64_t count) {
  if (count != 0) cells.push_back(error_count(what, count));
}

Group head(const CameraState& camera) {
  Group group{"camera", {words("id " + std::to_string(camera.key.id), Style::heading)}};
  auto& cells = group.cells;
  if (!camera.latest) {
    cells.push_back(words("no parameters yet", Style::warning));
  } else if (camera.latest->is_silent) {
    cells.push_back({"SILENT for", seconds(camera.latest->age), "s", Style::error});
  } else {
    cells.push_back({"", camera.rate ? fixed(*camera.rate, 2) : "-", "Hz"});
  }
  cells.push_back(words(transport::to_string(camera.key.sender)));
  if (!camera.latest) return group;
  if (camera.counts.state != base::CounterState::ignored) {
    cells.push_back({"counter", std::to_string(camera.latest->params.counter), ""});
  }
  if (camera.latest->time_code) cells.push_back(words(base::to_string(camera.latest->time_code->code)));
  if (!camera.latest->is_silent) cells.push_back({"age", seconds(camera.latest->age), "s"});
  return group;
}

Group position(const ParamsState& latest) {
  if (!latest.pose) {
    return {"position", {words("no pose: " + camera::describe(latest.pose.error()), Style::error)}};
  }
  const auto& at = latest.pose->translation();
  return {"position", {{"x", fixed(at.x(), 4), "m"}, {"y", fixed(at.y(), 4), "m"}, {"z", fixed(at.z(), 4), "m"}}};
}

Group angles(const ParamsState& latest) {
  if (!latest.pose) return {"angles", {}};
  const auto angles = camera::pan_tilt_roll(latest.pose->linear());
  return {"angles",
          {{"pan", fixed(angles.pan, 3), "deg"},
           {"tilt", fixed(angles.tilt, 3), "deg"},
           {"roll", fixed(angles.roll, 3), "deg"}}};
}

Group lens(const CameraState& camera) {
  const auto& latest = *camera.latest;
  Group group{"lens", {}};
  auto& cells = group.cells;
  const bool has_lens = latest.lens || latest.lens.error() != camera::CameraReason::no_lens;
  if (!has_lens) {
    cells.push_back(words("no lens"));
  } else if (latest.lens) {
    cells.push_back({"lens", fixed(latest.lens->image_distance, 3), "mm"});
  } else {
    cells.push_back(words("no lens: " + camera::describe(latest.lens.error()), Style::error));
  }
  if (latest.horizontal_angle) {
    cells.push_back({"fov h", fixed(*latest.horizontal_angle, 3), "deg"});
  } else if (camera.constants && latest.lens) {
    cells.push_back(words("no angle: " + camera::describe(latest.horizontal_angle.error()), Style::error));
  }
  if (has_lens) {
    cells.push_back({"focus", fixed(latest.params.focdist, 3), "m"});
    cells.push_back({"aperture", fixed(latest.params.aperture, 2), ""});
  }
  const auto add_count = [&cells](const char* name, const std::optional<std::int32_t>& count) {
    if (count) cells.push_back({name, std::to_string(*count), ""});
  };
  add_count("zoom encoder", latest.encoders.zoom);
  add_count("focus encoder", latest.encoders.focus);
  add_count("iris encoder", latest.encoders.iris);
  if (*latest.doubt != '\0') cells.push_back(words(latest.doubt, Style::warning));
  return group;
}

Group order(const base::SequenceCounts& counts) {
  Group group{"losses", {error_count("lost", counts.lost), error_count("out of order", counts.late)}};
  add_if_any(group.cells, "duplicate", counts.duplicates);
  add_if_any(group.cells, "restarts", counts.restarts);
  return group;
}

Group jitter(const std::optional<Jitter>& jitter) {
  if (!jitter) return {"jitter", {{"interval", "-", "ms"}}};
  return {"jitter",
          {{"interval", fixed_milliseconds(jitter->interval), "ms"},
           {"jitter", fixed_milliseconds(jitter->p50), "ms"},
           {"p99", fixed_milliseconds(jitter->p99), "ms"},
           {"worst", fixed_milliseconds(jitter->worst), "ms"}}};
}

Group rest(const CameraState& camera) {
  const auto& [motion, deviation] = camera.rest;
  if (camera.latest->is_silent || motion != Motion::still) return {"noise", {words(motion_of(camera))}};
  return {"noise",
          {{"noise x", fixed(deviation[0] * 1e3, 2), "mm"},
           {"noise y", fixed(deviation[1] * 1e3, 2), "mm"},
           {"noise z", fixed(deviation[2] * 1e3, 2), "mm"},
           {"n. pan", fixed(deviation[3], 4), "deg"},
           {"n. tilt", fixed(deviation[4], 4), "deg"},
           {"n. roll", fixed(deviation[5], 4), "deg"}}};
}

Group format(const ParamsState& latest) {
  std::string text = std::string(latest.origin) + ": " + wire::format_to_words(latest.params.format);
  const bool has_unknown = (latest.params.format & ~wire::known_format_bits) != 0;
  if (has_unknown) text += " and unknown bits";
  return {"format", {words(text, has_unknown ? Style::warning : Style::plain)}};
}

Group constants(const wire::CameraConstants& c) {
  Group group{"constants",
              {words("image " + std::to_string(c.image_width) + " x " + std::to_string(c.image_height) + " px"),
               words("chip " + fixed(c.chip_width, 3) + " x " + fixed(c.chip_height, 3) + " mm")}};
  if (c.blank_left != 0 || c.blank_right != 0 || c.blank_top != 0 || c.blank_bottom != 0) {
    group.cells.push_back(words("blanks left " + std::to_string(c.blank_left) + " right " +
                                std::to_string(c.blank_right) + " top " + std::to_string(c.blank_top) + " bottom " +
                                std::to_string(c.blank_bottom)));
  }
  if (const auto checked = camera::check(c); !checked) {
    group.cells.push_back(words(camera::describe(checked.error()), Style::error));
  }
  return group;
}

}  // namespace

std::string fixed(double value, int decimals) {
  constexpr double most_with_decimals = 1e7;
  const bool is_plain = std::abs(value) < most_with_decimals;
  // No -0.000.
  if (std::abs(value) * 2 < std::pow(10.0, -decimals)) value = 0;
  return is_plain ? base::fixed_text(value, decimals) : base::general_text(value, decimals);
}

std::string to_string(const Cell& cell) {
  std::string text = cell.label;
  for (const auto* part : {&cell.value, &cell.unit}) {
    if (!part->empty()) text += (text.empty() ? "" : " ") + *part;
  }
  return text;
}

Cell state_of(const transport::SourceStatistics& source) {
  switch (source.state) {
    case transport::SourceState::waiting:
      return words("waiting", Style::warning);
    case transport::SourceState::nothing_valid:
    case transport::SourceState::only_refused:
      return words("nothing valid", Style::error);
    case transport::SourceState::receiving:
      return words("receiving");
    case transport::SourceState::ended:
      return words("ended");
    case transport::SourceState::failed:
      return words("failed", Style::error);
  }
  return words("in an unknown state", Style::error);
}

std::vector<Cell> counts_of(const State& state) {
  std::vector<Cell> cells{{"records", std::to_string(state.source.records), ""},
                          error_count("malformed", state.source.malformed)};
  add_if_any(cells, "accepted despite a fault", state.source.doubtful);
  add_if_any(cells, "refused", state.source.refused);
  add_if_any(cells, "kernel drops", state.source.kernel_drops);
  add_if_any(cells, "overwritten", state.source.overwritten);
  add_if_any(cells, "unknown format bits", state.source.unknown_format_bits);
  add_if_any(cells, "of cameras beyond the limit", state.not_shown);
  cells.push_back(words(state.source_name));
  return cells;
}

std::vector<Cell> malformed_of(const State& state) {
  if (!state.malformed) return {};
  const auto& [fault, sender, age] = *state.malformed;
  return {words("last malformed " + seconds(age) + " s ago", Style::warning),
          words("from " + transport::to_string(sender) + ": " + describe(fault), Style::warning)};
}

std::vector<Group> groups_of(const CameraState& camera) {
  std::vector<Group> groups{head(camera)};
  if (camera.latest) {
    groups.push_back(position(*camera.latest));
    groups.push_back(angles(*camera.latest));
    groups.push_back(lens(camera));
    groups.push_back(order(camera.counts));
    groups.push_back(jitter(camera.jitter));
    groups.push_back(rest(camera));
    groups.push_back(format(*camera.latest));
  }
  if (camera.constants) groups.push_back(constants(*camera.constants));
  return groups;
}

std::vector<Cell> summary_of(const CameraState& camera) {
  auto cells = head(camera).cells;
  cells.resize(std::min<std::size_t>(cells.size(), 3));
  if (!camera.latest) return cells;
  cells.push_back(error_count("lost", camera.counts.lost));
  const auto turned = angles(*camera.latest).cells;
  cells.push_back(words(motion_of(camera)));
  cells.insert(cells.end(), turned.begin(), turned.end());
  return cells;
}

std::string motion_of(const CameraState& camera) {
  if (!camera.latest || camera.latest->is_silent || camera.rest.motion == Motion::unknown) return "noise -";
  return camera.rest.motion == Motion::moving ? "moving" : "at rest";
}

const ValueText& text_of(Value value) {
  static constexpr std::array<ValueText, value_count> texts{{{"x", "m", 4, 0.001},
                                                             {"y", "m", 4, 0.001},
                                                             {"z", "m", 4, 0.001},
                                                             {"pan", "deg", 3, 0.01},
                                                             {"tilt", "deg", 3, 0.01},
                                                             {"roll", "deg", 3, 0.01},
                                                             {"lens", "mm", 3, 0.01},
                                                             {"focus", "m", 3, 0.01},
                                                             {"aperture", "", 2, 0.1},
                                                             {"interval", "ms", 2, 1}}};
  return texts[static_cast<std::size_t>(value)];
}

}  // namespace trk_bridge::monitor
