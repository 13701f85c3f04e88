#include "text.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::monitor {
namespace {

constexpr std::size_t tight = 1;  // so that a pose has room in 80 columns

std::string fixed(double value, int decimals, int width = 0) {
  constexpr double most_with_decimals = 1e7;
  std::array<char, 64> text{};
  const bool is_plain = std::abs(value) < most_with_decimals;
  // No -0.000.
  if (std::abs(value) * 2 < std::pow(10.0, -decimals)) value = 0;
  std::snprintf(text.data(), text.size(), is_plain ? "%*.*f" : "%*.*g", width, decimals, value);
  return text.data();
}

std::string milliseconds(std::int64_t nanoseconds) { return fixed(static_cast<double>(nanoseconds) * 1e-6, 3); }

std::string seconds(double value) { return fixed(value, value < 10 ? 2 : 0) + " s"; }

/// A count that should be 0.
Span trouble(const char* what, std::uint64_t count) {
  return {std::string(what) + " " + std::to_string(count), count == 0 ? Style::plain : Style::warning};
}

void add_if_any(Group& group, const char* what, std::uint64_t count) {
  if (count != 0) group.items.push_back(trouble(what, count));
}

Span state_of(const transport::SourceStatistics& source) {
  switch (source.state) {
    case transport::SourceState::waiting:
      return {"waiting for " + source.waiting_for, Style::warning};
    case transport::SourceState::nothing_valid:
      return {"datagrams come, but none is trk", Style::error};
    case transport::SourceState::only_refused:
      return {"only senders that are not allowed: " + transport::to_string(source.last_refused), Style::error};
    case transport::SourceState::receiving:
      return {"receiving", Style::plain};
    case transport::SourceState::ended:
      return {"ended", Style::plain};
    case transport::SourceState::failed:
      return {"failed: " + source.error, Style::error};
  }
  return {"in an unknown state", Style::error};
}

Group head(const CameraState& camera) {
  Group group;
  group.items.push_back({"id " + std::to_string(camera.key.id), Style::heading});
  if (!camera.latest) {
    group.items.push_back({"no parameters yet", Style::warning});
  } else if (camera.latest->is_silent) {
    group.items.push_back({"SILENT for " + seconds(camera.latest->age), Style::error});
  } else {
    group.items.push_back({camera.rate ? fixed(*camera.rate, 2) + " Hz" : "- Hz"});
  }
  group.items.push_back({transport::to_string(camera.key.sender)});
  if (!camera.latest) return group;
  if (camera.counts.state != base::CounterState::ignored) {
    group.items.push_back({"counter " + std::to_string(camera.latest->params.counter)});
  }
  if (camera.latest->time_code) group.items.push_back({base::to_string(camera.latest->time_code->code)});
  if (!camera.latest->is_silent) group.items.push_back({"age " + seconds(camera.latest->age)});
  return group;
}

Group pose(const ParamsState& latest) {
  if (!latest.pose) return {{{"no pose: " + camera::describe(latest.pose.error()), Style::error}}};
  const auto& at = latest.pose->translation();
  const auto angles = camera::pan_tilt_roll(latest.pose->linear());
  return {{{"x " + fixed(at.x(), 4, 8)},
           {"y " + fixed(at.y(), 4, 8)},
           {"z " + fixed(at.z(), 4, 8) + " m"},
           {"pan " + fixed(angles.pan, 3, 8)},
           {"tilt " + fixed(angles.tilt, 3, 7)},
           {"roll " + fixed(angles.roll, 3, 8) + " deg"}},
          tight};
}

Group lens(const CameraState& camera) {
  const auto& latest = *camera.latest;
  Group group;
  const bool has_lens = latest.lens || latest.lens.error() != camera::CameraReason::no_lens;
  if (!has_lens) {
    group.items.push_back({"no lens"});
  } else if (latest.lens) {
    group.items.push_back({"lens " + fixed(latest.lens->image_distance, 3) + " mm"});
  } else {
    group.items.push_back({"no lens: " + camera::describe(latest.lens.error()), Style::error});
  }
  if (latest.horizontal_angle) {
    group.items.push_back({"horizontal " + fixed(*latest.horizontal_angle, 3) + " deg"});
  } else if (camera.constants && latest.lens) {
    group.items.push_back({"no angle: " + camera::describe(latest.horizontal_angle.error()), Style::error});
  }
  if (has_lens && !camera.constants) group.items.push_back({"NO CONSTANTS have come", Style::warning});
  if (has_lens) {
    group.items.push_back({"focus " + fixed(latest.params.focdist, 3) + " m"});
    group.items.push_back({"aperture " + fixed(latest.params.aperture, 2)});
  }
  const auto add_count = [&group](const char* name, const std::optional<std::int32_t>& count) {
    if (count) group.items.push_back({name + std::to_string(*count)});
  };
  add_count("zoom encoder ", latest.encoders.zoom);
  add_count("focus encoder ", latest.encoders.focus);
  add_count("iris encoder ", latest.encoders.iris);
  if (*latest.doubt != '\0') group.items.push_back({latest.doubt, Style::warning});
  return group;
}

Group order(const base::SequenceCounts& counts) {
  Group group{{trouble("lost", counts.lost), trouble("out of order", counts.late)}};
  add_if_any(group, "duplicate", counts.duplicates);
  add_if_any(group, "restarts", counts.restarts);
  return group;
}

Group jitter(const std::optional<Jitter>& jitter) {
  if (!jitter) return {{{"jitter -", Style::faint}}};
  return {{{"jitter p50 " + milliseconds(jitter->p50)},
           {"p99 " + milliseconds(jitter->p99)},
           {"worst " + milliseconds(jitter->worst) + " ms"},
           {"interval " + milliseconds(jitter->interval) + " ms"}}};
}

Group rest(const CameraState& camera) {
  const auto& [motion, deviation] = camera.rest;
  if (camera.latest->is_silent || motion == Motion::unknown) return {{{"noise at rest -", Style::faint}}};
  if (motion == Motion::moving) return {{{"moving", Style::faint}}};
  return {{{"noise at rest x " + fixed(deviation[0] * 1e3, 2)},
           {"y " + fixed(deviation[1] * 1e3, 2)},
           {"z " + fixed(deviation[2] * 1e3, 2) + " mm"},
           {"pan " + fixed(deviation[3], 4)},
           {"tilt " + fixed(deviation[4], 4)},
           {"roll " + fixed(deviation[5], 4) + " deg"}},
          tight};
}

Group format(const ParamsState& latest) {
  Group group;
  group.gap = tight;
  group.items.push_back({std::string(latest.origin) + ":", Style::faint});
  std::istringstream words(wire::format_to_words(latest.params.format));
  for (std::string word; words >> word;) group.items.push_back({word});
  if ((latest.params.format & ~wire::known_format_bits) != 0) {
    group.items.push_back({"and unknown bits", Style::warning});
  }
  return group;
}

Group constants(const wire::CameraConstants& c) {
  Group group{{{"image " + std::to_string(c.image_width) + " x " + std::to_string(c.image_height) + " px"},
               {"chip " + fixed(c.chip_width, 3) + " x " + fixed(c.chip_height, 3) + " mm"}}};
  if (c.blank_left != 0 || c.blank_right != 0 || c.blank_top != 0 || c.blank_bottom != 0) {
    group.items.push_back({"blanks left " + std::to_string(c.blank_left) + " right " + std::to_string(c.blank_right) +
                           " top " + std::to_string(c.blank_top) + " bottom " + std::to_string(c.blank_bottom)});
  }
  if (const auto sound = camera::check(c); !sound)
    group.items.push_back({camera::describe(sound.error()), Style::error});
  return group;
}

}  // namespace

std::vector<Group> groups_of(const State& state) {
  Group title{{{"trk monitor", Style::heading}, state_of(state.source)}};
  Group counts{{{"records " + std::to_string(state.source.records)}, trouble("malformed", state.source.malformed)}};
  add_if_any(counts, "taken in spite of a fault", state.source.doubtful);
  add_if_any(counts, "refused", state.source.refused);
  add_if_any(counts, "kernel drops", state.source.kernel_drops);
  add_if_any(counts, "overwritten", state.source.overwritten);
  add_if_any(counts, "unknown format bits", state.source.unknown_format_bits);
  add_if_any(counts, "of more cameras than are shown", state.not_shown);
  counts.items.push_back({state.source_name, Style::faint});
  std::vector<Group> groups{title, counts};
  if (state.malformed) {
    const auto& [fault, sender, age] = *state.malformed;
    groups.push_back({{{"last malformed " + seconds(age) + " ago", Style::warning},
                       {"from " + transport::to_string(sender) + ":", Style::warning},
                       {describe(fault), Style::warning}}});
  }
  return groups;
}

std::vector<Group> groups_of(const CameraState& camera) {
  std::vector<Group> groups{head(camera)};
  if (camera.latest) {
    groups.push_back(pose(*camera.latest));
    groups.push_back(lens(camera));
    groups.push_back(order(camera.counts));
    groups.push_back(jitter(camera.jitter));
    groups.push_back(rest(camera));
    groups.push_back(format(*camera.latest));
  }
  if (camera.constants) groups.push_back(constants(*camera.constants));
  return groups;
}

}  // namespace trk_bridge::monitor
