// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Guides the user through movements of a camera, and checks axes and signs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rest_window.h"

namespace trk_bridge::monitor {

/// Asks for one movement after another. The first number that changes by enough is taken as the axis of the movement.
/// Not synchronised.
class AxisCheck {
 public:
  /// Begins with the first step. `now`: the current pose; none if it is not known.
  void begin(const std::optional<PoseNumbers>& now);
  void end() { is_on_ = false; }
  bool is_on() const noexcept { return is_on_; }

  /// Begins the next step; after the last step, lines() shows the results.
  void next(const std::optional<PoseNumbers>& now);
  void look(const std::optional<PoseNumbers>& now);

  /// Instruction for the user, and results; empty if the check is off.
  std::vector<std::string> lines() const;

 private:
  bool is_over() const noexcept;

  bool is_on_ = false;
  std::size_t step_ = 0;
  std::optional<PoseNumbers> from_;
  std::vector<std::string> results_;  // of steps, including the current one when it is known
};

}  // namespace trk_bridge::monitor
