// A camera moved step by step, to see which of its numbers follows and with which sign.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rest_window.h"

namespace trk_bridge::monitor {

/// Asks for one movement after the other. Each is judged when the first number has moved far enough: that one is the
/// axis found. Not synchronised.
class AxisCheck {
 public:
  /// Begins with the first step. `now`: where the camera is; none where it is not known.
  void begin(const std::optional<PoseNumbers>& now);
  void end() { is_on_ = false; }
  bool is_on() const noexcept { return is_on_; }

  /// Begins the next step; after the last one shows the results.
  void next(const std::optional<PoseNumbers>& now);
  void look(const std::optional<PoseNumbers>& now);

  /// What the user is to do, and what was found; empty when it is off.
  std::vector<std::string> lines() const;

 private:
  bool is_over() const noexcept;

  bool is_on_ = false;
  std::size_t step_ = 0;
  std::optional<PoseNumbers> from_;
  std::vector<std::string> results_;  // of steps, the current one's included as soon as it is known
};

}  // namespace trk_bridge::monitor
