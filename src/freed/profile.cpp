// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trk_bridge::freed {
namespace {

constexpr std::array<std::pair<std::string_view, Profile>, 5> words{{{"generic", Profile::generic},
                                                                     {"sony", Profile::sony},
                                                                     {"zcam", Profile::zcam},
                                                                     {"vizrt", Profile::vizrt},
                                                                     {"mosys", Profile::mosys}}};

constexpr std::uint16_t iris_bits = 0x0FFF;
constexpr unsigned frame_shift = 12;

// Units of the profile zcam.
constexpr double focal_lengths_per_mm = 100;
constexpr double focus_distances_per_metre = 10000;
constexpr double irises_per_stop = 100;

constexpr std::int32_t zero_of(Profile profile) noexcept { return profile == Profile::vizrt ? 524288 : 0; }
constexpr bool has_iris(Profile profile) noexcept { return profile == Profile::sony || profile == Profile::zcam; }

bool set_count(double count, std::uint32_t& to) noexcept {
  if (!(count >= 0 && count <= most_count)) return false;
  to = static_cast<std::uint32_t>(std::lround(count));
  return true;
}

tl::expected<void, transport::Fault> set_counts(double zoom, double focus, Message& message) noexcept {
  if (!set_count(zoom, message.zoom)) return tl::make_unexpected(out_of_range(Field::zoom));
  if (!set_count(focus, message.focus)) return tl::make_unexpected(out_of_range(Field::focus));
  return {};
}

}  // namespace

std::optional<Profile> profile_of(std::string_view word) noexcept {
  const auto found = std::find_if(words.begin(), words.end(), [&](const auto& one) { return one.first == word; });
  if (found == words.end()) return std::nullopt;
  return found->second;
}

transport::LensEncoders encoders_of(const Message& message, Profile profile) noexcept {
  transport::LensEncoders encoders;
  encoders.zoom = static_cast<std::int32_t>(message.zoom) - zero_of(profile);
  encoders.focus = static_cast<std::int32_t>(message.focus) - zero_of(profile);
  if (has_iris(profile)) encoders.iris = message.spare & iris_bits;
  return encoders;
}

std::optional<camera::Lens> lens_of(const Message& message) noexcept {
  if (message.zoom == 0) return std::nullopt;
  camera::Lens lens;
  lens.image_distance = message.zoom / focal_lengths_per_mm;
  lens.focdist = message.focus / focus_distances_per_metre;
  lens.aperture = (message.spare & iris_bits) / irises_per_stop;
  return lens;
}

tl::expected<void, transport::Fault> set_encoders(const transport::LensEncoders& encoders, Profile profile,
                                                  Message& message) noexcept {
  const double zero = zero_of(profile);
  return set_counts(encoders.zoom.value_or(0) + zero, encoders.focus.value_or(0) + zero, message);
}

tl::expected<void, transport::Fault> set_lens(const camera::Lens& lens, Message& message) noexcept {
  const double iris = std::clamp(lens.aperture * irises_per_stop, 0.0, double{iris_bits});
  message.spare = static_cast<std::uint16_t>(std::lround(iris));
  return set_counts(lens.image_distance * focal_lengths_per_mm, lens.focdist * focus_distances_per_metre, message);
}

void set_frame(std::uint64_t frame, Profile profile, Message& message) noexcept {
  if (!has_iris(profile)) return;
  message.spare = static_cast<std::uint16_t>((message.spare & iris_bits) | (frame << frame_shift & 0xFFFFU));
}

}  // namespace trk_bridge::freed
