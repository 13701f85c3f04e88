// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "transform_filter.h"

#include <algorithm>
#include <utility>

#include "diagnostic_text.h"

namespace trk_bridge::bridge {
namespace {

constexpr std::int64_t most_off = 1'000'000'000;  // ns

/// tf2 ignores a leading slash.
std::string_view without_slash(std::string_view frame) { return frame.substr(frame.substr(0, 1) == "/" ? 1 : 0); }

}  // namespace

std::string describe(const StampJump& jump) {
  const std::string far = duration_text(jump.seconds);
  if (jump.kind == StampJump::Kind::ros_time_back) return "ROS time went back by " + far;
  const std::string whose = "the stamps of frame " + jump.frame + " from " + jump.sender;
  return jump.kind == StampJump::Kind::ahead ? whose + " are " + far + " ahead of ROS time"
                                             : whose + " went back by " + far;
}

TransformFilter::TransformFilter(std::string studio_frame, std::string camera_frame)
    : studio_frame_(std::move(studio_frame)), camera_frame_(std::move(camera_frame)) {}

TransformFilter::Link& TransformFilter::link_of(std::string_view parent, std::string_view child) {
  child = without_slash(child);
  auto found = links_.find(child);
  if (found == links_.end()) found = links_.emplace(child, Link{}).first;
  found->second.parent = without_slash(parent);
  return found->second;
}

bool TransformFilter::ros_time_went_back(std::int64_t ros_now) {
  const std::int64_t back = std::exchange(last_ros_now_, ros_now) - ros_now;
  if (back <= most_off) return false;
  start_over({StampJump::Kind::ros_time_back, "", "", seconds_between(0, back)});
  ahead_ = 0;
  return true;
}

TransformFilter::Verdict TransformFilter::classify(const StampedLink& given, std::int64_t ros_now, std::int64_t now) {
  auto& link = link_of(given.parent, given.child);
  const auto jump = jump_of(link, given, ros_now, now);
  if (jump) {
    if (!link.refused_since) link.refused_since = now;
    // Other links do not affect this camera.
    if (!pose_depends_on(link)) return Verdict::refuse;
    if (now - *link.refused_since < patience) {
      ++statistics_.refused;
      statistics_.last_refused = *jump;
      return Verdict::refuse;
    }
    start_over(*jump);
    ahead_ = std::max<std::int64_t>(given.stamp - ros_now, 0);
  }
  if (!link.newest || given.stamp > *link.newest) {
    link.newest = given.stamp;
    link.newest_at = now;
  }
  link.refused_since.reset();
  return jump ? Verdict::restart : Verdict::use;
}

std::optional<StampJump> TransformFilter::jump_of(const Link& link, const StampedLink& given, std::int64_t ros_now,
                                                  std::int64_t now) const {
  const std::int64_t expected = link.newest ? *link.newest + (now - link.newest_at) : ros_now + ahead_;
  if (given.stamp > std::max(ros_now, expected) + most_off) {
    return StampJump{StampJump::Kind::ahead, std::string(given.child), std::string(given.sender),
                     seconds_between(ros_now, given.stamp)};
  }
  if (link.newest && given.stamp < *link.newest - most_off) {
    return StampJump{StampJump::Kind::back, std::string(given.child), std::string(given.sender),
                     seconds_between(given.stamp, expected)};
  }
  return std::nullopt;
}

bool TransformFilter::pose_depends_on(const Link& link) const {
  for (const auto& end : {camera_frame_, studio_frame_}) {
    const std::string* frame = &end;
    // Wrong transforms can form a loop.
    for (std::size_t steps = 0; steps <= links_.size(); ++steps) {
      const auto found = links_.find(*frame);
      if (found == links_.end()) break;
      if (&found->second == &link) return true;
      frame = &found->second.parent;
    }
  }
  return false;
}

void TransformFilter::start_over(const StampJump& jump) {
  ++statistics_.restarts;
  statistics_.last_restart = jump;
  for (auto& [child, link] : links_) {
    link.newest.reset();
    link.refused_since.reset();
  }
}

}  // namespace trk_bridge::bridge
