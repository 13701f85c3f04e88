// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The status of a display, updated slowly enough to be readable.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace trk_bridge::rviz_display {

enum class StatusLevel { ok, warn, error };

/// A new level is shown at once, a new text with the same level only a few times a second, because ages and counts
/// would flicker. For one thread.
class StatusLines {
 public:
  using Show = std::function<void(StatusLevel, const std::string& name, const std::string& text)>;
  using Remove = std::function<void(const std::string& name)>;
  static constexpr double period = 0.3;  ///< seconds between texts

  StatusLines(Show show, Remove remove) : show_(std::move(show)), remove_(std::move(remove)) {}

  /// Call repeatedly while the condition lasts. `now` is the steady clock, seconds.
  void set(StatusLevel level, const std::string& name, const std::string& text, double now);
  void remove(const std::string& name);
  /// Call when all lines were removed elsewhere.
  void forget() { lines_.clear(); }

 private:
  struct Line {
    StatusLevel level;
    std::string text;
    double shown;  // when
  };
  Show show_;
  Remove remove_;
  std::map<std::string, Line> lines_;
};

}  // namespace trk_bridge::rviz_display
