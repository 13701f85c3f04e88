#include "finding.h"

#include <algorithm>
#include <cstdio>

#include "diagnostic_text.h"

namespace trk_bridge::bridge {
namespace {

constexpr double nanoseconds_per_second = 1e9;

}  // namespace

void summarize(const std::vector<Finding>& found, Status& status) {
  Level level = Level::ok;
  std::string text;
  for (const auto& finding : found) {
    level = std::max(level, finding.level);
    text += (text.empty() ? "" : "; ") + finding.text;
  }
  status.level = level;
  status.message = text;
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", seconds);
  return text;
}

std::string rate_text(double rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", rate);
  return text;
}

std::string pixels_text(double pixels) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", pixels);
  return text;
}

double seconds_between(std::int64_t from, std::int64_t to) {
  return static_cast<double>(to - from) / nanoseconds_per_second;
}

double rate_between(std::uint64_t events_before, std::uint64_t events_now, std::int64_t from, std::int64_t to) {
  const double seconds = seconds_between(from, to);
  return seconds <= 0 ? 0 : static_cast<double>(events_now - events_before) / seconds;
}

}  // namespace trk_bridge::bridge
