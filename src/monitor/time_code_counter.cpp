// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "time_code_counter.h"

#include <cstdio>

namespace trk_bridge::monitor {
namespace {

using Code = TimeCodeCounter::Code;

// A plain count reaches 60 to 99 (or, in bytes, 255), a frame number does not.
constexpr int most_frames = 60, fewest_frames = 23;
constexpr int enough_seconds = 2;
constexpr std::int64_t day = 86400;

std::optional<Code> code_of(std::int64_t hours, std::int64_t minutes, std::int64_t seconds, std::int64_t frame) {
  if (hours > 23 || minutes > 59 || seconds > 59 || frame >= most_frames) return {};
  return Code{(hours * 60 + minutes) * 60 + seconds, static_cast<int>(frame)};
}

std::optional<Code> of_parts(std::uint64_t counter, std::uint64_t base) {
  const auto part = [&](std::uint64_t divisor) { return static_cast<std::int64_t>(counter / divisor % base); };
  if (counter / (base * base * base) >= base) return {};
  return code_of(part(base * base * base), part(base * base), part(base), part(1));
}

std::optional<Code> of_digits(std::uint64_t counter) { return of_parts(counter, 100); }
std::optional<Code> of_bytes(std::uint64_t counter) { return of_parts(counter, 256); }

std::optional<Code> of_coded_decimals(std::uint64_t counter) {
  if (counter > 0xFFFFFFFF) return {};
  std::uint64_t digits = 0;
  for (int shift = 28; shift >= 0; shift -= 4) {
    const std::uint64_t digit = counter >> shift & 0xF;
    if (digit > 9) return {};
    digits = 10 * digits + digit;
  }
  return of_digits(digits);
}

std::optional<Code> of_frames(std::uint64_t counter) {
  if (counter >= static_cast<std::uint64_t>(most_frames)) return {};
  return Code{0, static_cast<int>(counter)};
}

struct Encoding {
  std::optional<Code> (*code)(std::uint64_t counter);
  const char* name;
};
constexpr std::size_t frames_alone = 3;
constexpr std::array<Encoding, 4> encodings{{{of_digits, "as decimal digits"},
                                             {of_coded_decimals, "as binary coded decimals"},
                                             {of_bytes, "with a byte for each part"},
                                             {of_frames, "its frame number alone"}}};

}  // namespace

void TimeCodeCounter::add(std::uint64_t counter) noexcept {
  for (std::size_t i = 0; i < encodings.size(); ++i) {
    auto& [last, length, seconds] = guesses_[i];
    const auto code = encodings[i].code(counter);
    const bool goes_on = last && code && code->second == last->second && code->frame >= last->frame;
    bool begins_second = last && code && !goes_on;
    if (begins_second && i == frames_alone) {
      const int ended = last->frame + 1;
      begins_second = code->frame <= 1 && ended >= fewest_frames && (seconds == 0 || ended == length);
      length = ended;
    } else if (begins_second) {
      begins_second = code->second == (last->second + 1) % day && code->frame < last->frame;
    }
    if (begins_second) ++seconds;
    if (!goes_on && !begins_second) seconds = 0;
    last = code;
  }
}

std::optional<std::string> TimeCodeCounter::description() const {
  for (std::size_t i = 0; i < encodings.size(); ++i) {
    const auto& [last, length, seconds] = guesses_[i];
    if (seconds < enough_seconds || !last) continue;
    if (i == frames_alone) return std::string(encodings[i].name) + ", 0 to " + std::to_string(length - 1);
    char text[64];
    std::snprintf(text, sizeof text, "%02d:%02d:%02d:%02d %s", static_cast<int>(last->second / 3600),
                  static_cast<int>(last->second / 60 % 60), static_cast<int>(last->second % 60), last->frame,
                  encodings[i].name);
    return text;
  }
  return {};
}

}  // namespace trk_bridge::monitor
