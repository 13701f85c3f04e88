// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bridge/diagnostic_text.h"

namespace trk_bridge::monitor {
namespace {

using bridge::Condition;
using bridge::Finding;
using bridge::Level;

constexpr std::uint64_t fewest_missed = 5;  // datagrams; fewer can have other reasons

/// If both are found, the first one explains the second one, which is removed.
using Explanation = std::pair<Condition, Condition>;
constexpr std::array<Explanation, 5> of_one_camera{{
    {Condition::time_code_counter, Condition::lost},
    {Condition::time_code_counter, Condition::uncounted},
    {Condition::time_code_counter, Condition::rate},
    {Condition::time_code_counter, Condition::stalls},
    {Condition::time_code_counter, Condition::bursts},
}};
constexpr std::array<Explanation, 2> of_all{{
    {Condition::other_interface, Condition::waiting},
    {Condition::other_interface, Condition::nothing_new},
}};

/// Within a level, these come first in this order, then those in neither list.
constexpr std::array<Condition, 3> first{Condition::other_interface, Condition::foreign_sender,
                                         Condition::time_code_counter};
constexpr std::array<Condition, 4> last{Condition::no_constants, Condition::bursts, Condition::stalls, Condition::rate};

constexpr std::array<Condition, 8> of_the_source{
    Condition::waiting,      Condition::ended,     Condition::failed,  Condition::nothing_valid,
    Condition::only_refused, Condition::malformed, Condition::refused, Condition::kernel_drops};

template <typename List>
bool has(const List& list, Condition condition) {
  return std::find(list.begin(), list.end(), condition) != list.end();
}

int rank(const Finding& finding) {
  constexpr int of_a_level = 100, of_no_list = 10;
  const int level = finding.level == Level::error ? 0 : finding.level == Level::ok ? 2 : 1;
  int place = of_no_list;
  if (has(first, finding.condition)) {
    place = static_cast<int>(std::find(first.begin(), first.end(), finding.condition) - first.begin());
  } else if (has(last, finding.condition)) {
    place += 1 + static_cast<int>(std::find(last.begin(), last.end(), finding.condition) - last.begin());
  }
  return of_a_level * level + place;
}

std::string milliseconds(std::int64_t nanoseconds) {
  return std::to_string(std::llround(static_cast<double>(nanoseconds) * 1e-6)) + " ms";
}

std::string in_the_time_of(const bridge::CameraReport& now, const bridge::CameraReport& before) {
  return " in " + bridge::duration_text(bridge::seconds_between(before.time, now.time));
}

void add_missed(std::vector<Finding>& found, const SourceReports& reports) {
  const auto& now = reports.now.source;
  const auto& before = reports.before.source;
  const bool is_udp = reports.now.source_name.rfind("udp ", 0) == 0;
  const bool is_quiet =
      now.records == before.records && now.malformed == before.malformed && now.refused == before.refused;
  if (!is_udp || !is_quiet) return;
  const std::string when = in_the_time_of(reports.now, reports.before);
  if (reports.missed.reverse_path >= fewest_missed) {
    bridge::warn(found, Condition::other_interface,
                 "nothing is received, but this machine discarded " + std::to_string(reports.missed.reverse_path) +
                     " packets" + when +
                     " because their sender is reached through another interface (reverse path filter)");
  } else if (reports.missed.unclaimed >= fewest_missed) {
    bridge::warn(found, Condition::other_interface,
                 "nothing is received by " + reports.now.source_name + ", but " +
                     std::to_string(reports.missed.unclaimed) + " datagrams" + when +
                     " arrived at an address or port of this machine where no program listens: perhaps the sender uses "
                     "another interface, address or port");
  }
}

/// Rates such as 59.94 Hz are often mistaken for the nearest whole number.
void add_rate(std::vector<Finding>& found, const bridge::CounterClockStatistics& rhythm) {
  const auto* standard = rhythm.learned ? bridge::standard_rate(1e9 / rhythm.interval) : nullptr;
  if (standard == nullptr) return;
  const long whole = std::lround(standard->rate);
  if (std::abs(standard->rate - static_cast<double>(whole)) < 1e-6) return;
  found.push_back(
      {Condition::rate, Level::ok, std::string("the rate is ") + standard->name + " Hz, not " + std::to_string(whole)});
}

void add_unevenness(std::vector<Finding>& found, const Unevenness& uneven) {
  if (uneven.kind == Unevenness::Kind::bursts) {
    bridge::warn(found, Condition::bursts,
                 "records arrive in bursts: " + std::to_string(uneven.at_once) + " at once every " +
                     milliseconds(uneven.longest) + ", not one every " + milliseconds(uneven.interval));
  } else if (uneven.kind == Unevenness::Kind::stalls) {
    const bool were_held = uneven.at_once > 1;
    bridge::warn(found, Condition::stalls,
                 "arrivals stall: " + std::to_string(uneven.count) + (uneven.count == 1 ? " time" : " times") +
                     " in the last 10 s, for up to " + milliseconds(uneven.longest) +
                     (were_held ? "; then " + std::to_string(uneven.at_once) + " records arrived at once"
                                : "; the sender paused, nothing was lost"));
  }
}

void add_own(std::vector<Finding>& found, const CameraReports& reports) {
  const auto& camera = reports.now.camera;
  if (!reports.time_code.empty()) {
    bridge::warn(
        found, Condition::time_code_counter,
        "the counter is a time code (" + reports.time_code + "), not a count, so lost records are not visible in it");
  }
  if (camera.sequence.accepted == 0) return;
  if (camera.has_lens && camera.constants == bridge::ConstantsOrigin::none) {
    bridge::warn(found, Condition::no_constants,
                 "no constants received: without image size and chip size, pixels and the angle of view are unknown");
  }
  add_rate(found, camera.rhythm);
  add_unevenness(found, reports.unevenness);
}

/// Replaces texts of the bridge by texts for a user who only watches.
void reword(Finding& finding, const CameraReports& reports) {
  const auto& camera = reports.now.camera;
  if (finding.condition == Condition::foreign_sender) {
    finding.text = "two senders use this id: " + transport::to_string(camera.sender) + " and " +
                   transport::to_string(camera.foreign_sender) +
                   "; a receiver that follows one ignores the other, others mix them";
  } else if (finding.condition == Condition::lost) {
    const auto lost = camera.sequence.lost - reports.before.camera.sequence.lost;
    const auto sent = lost + camera.sequence.accepted - reports.before.camera.sequence.accepted;
    finding.text += " of " + std::to_string(sent) + " records" + in_the_time_of(reports.now, reports.before) + " (" +
                    bridge::two_decimals(100.0 * static_cast<double>(lost) / static_cast<double>(sent)) + " %)";
  }
}

template <typename Explanations>
void remove_explained(std::vector<Finding>& found, const Explanations& explanations) {
  for (const auto& [cause, effect] : explanations) {
    const auto is = [](Condition condition) {
      return [condition](const Finding& finding) { return finding.condition == condition; };
    };
    if (std::none_of(found.begin(), found.end(), is(cause))) continue;
    found.erase(std::remove_if(found.begin(), found.end(), is(effect)), found.end());
  }
}

/// Keeps `receiving` only if there are no other findings.
void summarize_good(std::vector<Finding>& found) {
  const auto good = std::stable_partition(
      found.begin(), found.end(), [](const Finding& finding) { return finding.condition != Condition::receiving; });
  const auto cameras = found.end() - good;
  const bool has_others = good != found.begin();
  if (has_others || cameras > 1) found.erase(good, found.end());
  if (!has_others && cameras > 1) {
    found.push_back(
        {Condition::receiving, Level::ok, "nothing is wrong: " + std::to_string(cameras) + " cameras are received"});
  }
}

std::vector<Finding> of_camera(const CameraReports& reports) {
  const auto options = watch_options(reports.id);
  const double rate =
      reports.now.camera.rhythm.interval > 0 ? 1e9 / reports.now.camera.rhythm.interval : bridge::assumed_field_rate;
  auto found = bridge::findings(reports.now, reports.before, options, rate);
  // A monitor does not make stamps.
  found.erase(std::remove_if(found.begin(), found.end(),
                             [](const Finding& finding) { return finding.condition == Condition::stamps_held; }),
              found.end());
  for (auto& finding : found) reword(finding, reports);
  add_own(found, reports);
  remove_explained(found, of_one_camera);
  for (auto& finding : found) {
    if (!has(of_the_source, finding.condition)) finding.text = "id " + std::to_string(reports.id) + ": " + finding.text;
  }
  return found;
}

}  // namespace

bridge::CameraOptions watch_options(std::uint32_t id) {
  bridge::CameraOptions options;
  options.id = id;
  options.format.reset();
  options.publish_camera_info = false;
  return options;
}

std::vector<Finding> findings_of(const SourceReports& reports) {
  std::vector<Finding> found;
  if (reports.cameras.empty()) {
    found = bridge::findings(reports.now, reports.before, {}, bridge::assumed_field_rate);
    for (auto& finding : found) {
      if (finding.condition == Condition::waiting) finding.text = "waiting for " + finding.text;
    }
  }
  add_missed(found, reports);
  for (const auto& camera : reports.cameras) {
    for (auto& finding : of_camera(camera)) {
      // Findings of the source are reported with each of its cameras.
      const auto is_same = [&finding](const Finding& other) { return other.text == finding.text; };
      if (std::none_of(found.begin(), found.end(), is_same)) found.push_back(std::move(finding));
    }
  }
  remove_explained(found, of_all);
  summarize_good(found);
  std::stable_sort(found.begin(), found.end(), [](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
  return found;
}

}  // namespace trk_bridge::monitor
