// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "paced_camera.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "trk_bridge/wire/fields.h"

namespace trk_bridge::bridge {
namespace {

constexpr std::int64_t largest_jump = 1'000'000'000;  // ns

PartTimes times_at(std::int64_t clock, const transport::Delay& delay) noexcept {
  return {clock - delay.position, clock - delay.rotation, clock - delay.lens};
}

PartTimes not_before(const PartTimes& times, const PartTimes& others) noexcept {
  return {std::max(times.position, others.position), std::max(times.rotation, others.rotation),
          std::max(times.lens, others.lens)};
}

/// If any part has a delay, only parts with a delay count: the others are sent as new as possible.
std::int64_t least_margin(const PartTimes& margins, const transport::Delay& delay) noexcept {
  const bool all = delay == transport::Delay{};
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  if (all || delay.position > 0) least = std::min(least, margins.position);
  if (all || delay.rotation > 0) least = std::min(least, margins.rotation);
  if (all || delay.lens > 0) least = std::min(least, margins.lens);
  return least;
}

bool is_same(const PartTimes& a, const PartTimes& b) noexcept {
  return a.position == b.position && a.rotation == b.rotation && a.lens == b.lens;
}

}  // namespace

PacedCamera::PacedCamera(std::optional<double> rate, const std::vector<OutputTiming>& outputs) : rhythm_(rate) {
  for (const auto& timing : outputs) {
    outputs_.emplace_back();
    outputs_.back().timing = timing;
  }
}

camera::Result<void> PacedCamera::add(const wire::CameraParams& params, std::int64_t time, std::int64_t lens_time,
                                      std::int64_t now, std::int64_t clock) noexcept {
  arrival_ = now;
  rhythm_.arrive(now);
  if (!due_) due_ = rhythm_.next(now);
  const auto camera = camera::decode_relative(params);
  if (!camera) return tl::unexpected(camera.error());
  if (time == 0) time = clock - offset_;
  if (lens_time == 0) lens_time = time;
  if (std::abs(time + offset_ - clock) > largest_jump) {
    const bool agrees = std::abs(time - clock) <= largest_jump;
    offset_ = agrees ? 0 : clock - time;
    history_.clear();
  }
  time += offset_;
  lens_time += offset_;
  const bool jumps = !history_.is_empty() && std::abs(time - history_.newest()) > largest_jump;
  if (jumps || params.format != newest_.format) history_.clear();
  if (history_.is_empty()) {
    for (auto& output : outputs_) output.last.reset();
  }
  if (const auto order = order_.classify(params.counter, wire::fingerprint(params));
      !base::is_new(order) && !history_.is_empty() && time > history_.newest()) {
    ++ignored_;
    return {};
  }
  if (!first_counter_) first_counter_ = params.counter;
  newest_ = params;
  history_.add(*camera, time, lens_time);
  return {};
}

void PacedCamera::depart(std::int64_t now, std::int64_t clock) noexcept {
  departure_ = now;
  due_ = rhythm_.next(now);
  const bool is_live = !history_.is_empty() && now - arrival_ < largest_jump;
  for (auto& output : outputs_) {
    output.is_due = true;
    if (!is_live) continue;
    const auto found = history_.at(times_at(clock, output.timing.delay), 0);
    if (!found) continue;
    auto& statistics = output.statistics;
    ++statistics.departures;
    const auto margin = least_margin(found->margins, output.timing.delay);
    if (margin < 0) ++statistics.negative;
    statistics.margin_sum += static_cast<double>(margin) / rhythm_.sample_period();
  }
}

bool PacedCamera::waits(std::int64_t now) const noexcept {
  // A later sample waits for the next departure, which follows soon; otherwise all later ones would be too early.
  const bool is_late = static_cast<double>(now - departure_) > 0.7 * rhythm_.period();
  return !is_late && std::any_of(outputs_.begin(), outputs_.end(), [](const Output& output) { return output.is_due; });
}

DepartureStatistics PacedCamera::statistics(std::size_t output) const noexcept {
  auto statistics = outputs_[output].statistics;
  statistics.ignored = ignored_;
  return statistics;
}

std::optional<PacedCamera::Departure> PacedCamera::take(std::size_t index, std::int64_t now,
                                                        std::int64_t clock) noexcept {
  auto& output = outputs_[index];
  if (!output.is_due || !waits(now)) return std::nullopt;
  auto wanted = times_at(clock, output.timing.delay);
  if (output.last) wanted = not_before(wanted, *output.last);
  auto found = history_.at(wanted, output.timing.lead);
  if (!found) return std::nullopt;
  if (output.last && is_same(found->times, *output.last)) return std::nullopt;
  auto params = camera::encode_relative(found->camera, newest_.format);
  // If extrapolation gives invalid numbers, the newest sample is sent instead of nothing.
  if (!params) params = newest_;
  output.is_due = false;
  output.last = found->times;
  params->id = newest_.id;
  params->counter = *first_counter_ + output.counted++;
  auto& statistics = output.statistics;
  ++statistics.sent;
  statistics.last_sent = now;
  statistics.last_time = found->times.position - offset_;
  statistics.age_sum += static_cast<double>(clock - found->times.position);
  return Departure{*params, statistics.last_time};
}

}  // namespace trk_bridge::bridge
