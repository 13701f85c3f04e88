// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Protects a tf buffer from transforms with wrong stamps, which would block it, and follows clocks that were set.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace trk_bridge::bridge {

/// A stamp that does not continue those before it.
struct StampJump {
  enum class Kind : std::uint8_t {
    ahead,          ///< of ROS time
    back,           ///< behind the link's own clock
    ros_time_back,  ///< the clock of ROS, not of a link
  };
  Kind kind = Kind::ahead;
  std::string frame;   ///< the link's child
  std::string sender;  ///< the node that published it
  double seconds = 0;  ///< how far, more than 0
};
std::string describe(const StampJump&);

/// Counts only jumps of links that the pose depends on.
struct TransformFilterStatistics {
  std::uint64_t refused = 0;  ///< transforms
  StampJump last_refused;
  std::uint64_t restarts = 0;  ///< how often a clock that was set was followed
  StampJump last_restart;
};

/// One transform of tf. Stamp in ns since 1970. The caller owns the texts.
struct StampedLink {
  std::string_view parent, child;
  std::int64_t stamp = 0;
  std::string_view sender;
};

/// Checks every transform before it is put into a tf buffer. A buffer holds the newest 10 s: after one transform far in
/// the future it removes the others of that link and refuses all later ones; the same happens when a clock is set back.
/// A stamp may be up to 1 s ahead of ROS time, or of the current time of its link's clock, and up to 1 s behind the
/// newest stamp of the link. Other transforms are refused. If a link has had only such transforms for `patience`, its
/// clock was set: then the buffer must be cleared, and the new clock is used. Not synchronised: one thread at a time.
class TransformFilter {
 public:
  enum class Verdict : std::uint8_t {
    use,
    refuse,
    restart,  ///< clear all but static transforms from the buffer, then use it
  };
  /// ns until a jump is followed; with the period of the link, less than 1 s of poses is lost.
  static constexpr std::int64_t patience = 300'000'000;

  /// The pose is that of `camera_frame` in `studio_frame`.
  TransformFilter(std::string studio_frame, std::string camera_frame);

  /// Adds a link without stamps.
  void add_static(std::string_view parent, std::string_view child) { link_of(parent, child); }
  /// Whether ROS time, `ros_now`, has gone back by more than 1 s since the last call: then the buffer must be cleared.
  /// Call it before classify().
  bool ros_time_went_back(std::int64_t ros_now);
  /// `ros_now` is ROS time, `now` the steady clock, both ns. Allocates only for new links and for jumps.
  Verdict classify(const StampedLink&, std::int64_t ros_now, std::int64_t now);

  const TransformFilterStatistics& statistics() const noexcept { return statistics_; }

 private:
  struct Link {
    std::string parent;
    std::optional<std::int64_t> newest;         // stamp
    std::int64_t newest_at = 0;                 // when it arrived, steady clock
    std::optional<std::int64_t> refused_since;  // steady clock; first refusal since the last valid transform
  };

  Link& link_of(std::string_view parent, std::string_view child);
  std::optional<StampJump> jump_of(const Link&, const StampedLink&, std::int64_t ros_now, std::int64_t now) const;
  bool pose_depends_on(const Link&) const;
  void start_over(const StampJump&);

  const std::string studio_frame_, camera_frame_;
  std::map<std::string, Link, std::less<>> links_;  // by their child
  std::int64_t ahead_ = 0;                          // ns that the followed clock is ahead of ROS time
  std::int64_t last_ros_now_ = 0;
  TransformFilterStatistics statistics_;
};

}  // namespace trk_bridge::bridge
