// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "axis_check.h"

#include <array>
#include <cmath>

#include "text.h"

namespace trk_bridge::monitor {
namespace {

struct Step {
  const char* what;    // "pan left"
  const char* how;     // explanation
  std::size_t number;  // index of PoseNumbers that must increase
};
constexpr std::array<Step, 6> steps{{{"pan left", "", 3},
                                     {"tilt up", "lens upwards", 4},
                                     {"roll clockwise", "as the operator sees it", 5},
                                     {"move to the right wall", "right when looking into the studio", 0},
                                     {"move to the back wall", "away from the audience", 1},
                                     {"move up", "", 2}}};

constexpr PoseNumbers far_enough{0.1, 0.1, 0.1, 5, 5, 5};
constexpr double also_moved = 0.5;  // share of the largest, to be mentioned

const char* name_of(std::size_t number) { return text_of(static_cast<Value>(number)).name; }

/// "pan +5.20 deg"
std::string moved_text(std::size_t number, double by) {
  const auto& value = text_of(static_cast<Value>(number));
  return std::string(value.name) + (by < 0 ? " " : " +") + fixed(by, 2) + " " + value.unit;
}

std::string verdict(const Step& step, std::size_t found, double by) {
  std::string text = std::string(step.what) + ": " + moved_text(found, by) + ": ";
  if (found != step.number) return text + "WRONG AXIS, " + name_of(step.number) + " should grow";
  return text + (by > 0 ? "right" : std::string("WRONG SIGN, ") + name_of(step.number) + " should grow");
}

}  // namespace

bool AxisCheck::is_over() const noexcept { return step_ >= steps.size(); }

void AxisCheck::begin(const std::optional<PoseNumbers>& now) {
  is_on_ = true;
  step_ = 0;
  from_ = now;
  results_.clear();
}

void AxisCheck::next(const std::optional<PoseNumbers>& now) {
  if (is_over()) return;
  if (results_.size() == step_) results_.push_back(std::string(steps[step_].what) + ": skipped");
  ++step_;
  from_ = now;
}

void AxisCheck::look(const std::optional<PoseNumbers>& now) {
  if (!is_on_ || is_over() || results_.size() > step_ || !now) return;
  if (!from_) from_ = now;
  PoseNumbers moved{}, share{};
  std::size_t most = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i] = (*now)[i] - (*from_)[i];
    if (i >= first_angle) moved[i] = std::remainder(moved[i], 360.0);
    share[i] = std::abs(moved[i]) / far_enough[i];
    if (share[i] > share[most]) most = i;
  }
  if (share[most] < 1) return;
  std::string result = verdict(steps[step_], most, moved[most]);
  for (std::size_t i = 0; i < share.size(); ++i) {
    if (i != most && share[i] > also_moved * share[most]) result += "; also " + moved_text(i, moved[i]);
  }
  results_.push_back(result);
}

std::vector<std::string> AxisCheck::lines() const {
  if (!is_on_) return {};
  std::vector<std::string> lines;
  if (is_over()) {
    lines.emplace_back("AXIS CHECK: all steps done");
  } else {
    const auto& step = steps[step_];
    std::string text =
        "AXIS CHECK " + std::to_string(step_ + 1) + "/" + std::to_string(steps.size()) + ": " + step.what + " now";
    if (*step.how != '\0') text += " (" + std::string(step.how) + ")";
    if (!from_) text += "; no pose received";
    if (results_.size() > step_) text = "AXIS CHECK: found; space when the camera stands still again";
    lines.push_back(text);
  }
  lines.insert(lines.end(), results_.rbegin(), results_.rend());
  return lines;
}

}  // namespace trk_bridge::monitor
