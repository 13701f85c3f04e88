#include "stamper.h"

#include <limits>

namespace trk_bridge::ros1 {
namespace {

constexpr std::int64_t nanoseconds_per_second = 1'000'000'000;
constexpr std::int64_t latest =
    std::int64_t{std::numeric_limits<std::uint32_t>::max()} * nanoseconds_per_second + nanoseconds_per_second - 1;

}  // namespace

std::optional<::ros::Time> to_time(std::int64_t nanoseconds) noexcept {
  if (nanoseconds <= 0 || nanoseconds > latest) return std::nullopt;
  return ::ros::Time(static_cast<std::uint32_t>(nanoseconds / nanoseconds_per_second),
                     static_cast<std::uint32_t>(nanoseconds % nanoseconds_per_second));
}

std::optional<::ros::Time> Stamper::stamp(std::int64_t arrival) noexcept {
  // An arrival from outside of ROS time must not push the stamps of all that come after it.
  if (arrival < 0 || arrival > latest) return std::nullopt;
  const std::int64_t wanted = arrival - delay_;
  std::int64_t given = wanted;
  if (newest_ > 0 && given <= newest_) {
    given = newest_ + least_step;
    ++held_;
  }
  const auto time = to_time(given);
  if (!time) return std::nullopt;
  newest_ = given;
  ahead_ = given - wanted;
  return time;
}

}  // namespace trk_bridge::ros1
