// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "numeric.h"
#include "params.h"
#include "trk_bridge/camera/image.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::camera {
namespace {

using wire::CameraConstants;
using wire::has;

/// Chip sizes in ASCII constants may have only six digits. One blank line changes the fake chip by more than this in
/// images of all usual sizes.
constexpr double chip_tolerance = 2e-5;

/// The part of the image that shows the chip, in pixels.
Eigen::Array2d picture_size(const CameraConstants& c) noexcept {
  return {static_cast<double>(c.image_width) - c.blank_left - c.blank_right,
          static_cast<double>(c.image_height) - c.blank_top - c.blank_bottom};
}

Eigen::Array2d image_size(const CameraConstants& c) noexcept {
  return {static_cast<double>(c.image_width), static_cast<double>(c.image_height)};
}

Eigen::Array2d chip_size(const CameraConstants& c) noexcept { return {c.chip_width, c.chip_height}; }

Eigen::Array2d computed_fake_chip(const CameraConstants& c, std::uint32_t format) noexcept {
  Eigen::Array2d growth = image_size(c) / picture_size(c);
  if (has(format, wire::keep_aspect)) growth.y() = growth.x();
  return growth * chip_size(c);
}

/// The fake chip from the sender if it is valid, else the computed one.
Eigen::Array2d fake_chip(const CameraConstants& c, std::uint32_t format) noexcept {
  const Eigen::Array2d sent(c.fake_chip_width, c.fake_chip_height);
  return sent.isFinite().all() && (sent > 0).all() ? sent : computed_fake_chip(c, format);
}

/// The options that fov depends on; vertical takes precedence over diagonal.
std::uint32_t fov_options(std::uint32_t format) noexcept {
  if (!has(format, wire::field_of_view)) return 0;
  std::uint32_t options = wire::field_of_view;
  options |= has(format, wire::vertical) ? wire::vertical : format & wire::diagonal;
  if (has(format, wire::ignore_blank)) options |= wire::ignore_blank | (format & wire::keep_aspect);
  return options;
}

/// The options that the centre shift depends on. The fake chip is relevant only if the shift is in its pixels.
std::uint32_t shift_options(std::uint32_t format) noexcept {
  const std::uint32_t scaled_by_fake_chip = wire::ignore_blank | wire::shift_in_pixels;
  return format & (scaled_by_fake_chip | (has(format, scaled_by_fake_chip) ? wire::keep_aspect : 0U));
}

Result<void> check_needed(const CameraConstants* constants) noexcept {
  if (constants == nullptr) return tl::unexpected(CameraReason::constants_needed);
  return check(*constants);
}

bool operator==(const FovTerms& a, const FovTerms& b) noexcept { return a.side == b.side; }

Result<FovTerms> fov_terms(std::uint32_t format, const CameraConstants* constants) noexcept {
  if (!has(format, wire::field_of_view)) return FovTerms{};
  if (const auto known = check_needed(constants); !known) return tl::unexpected(known.error());
  const Eigen::Array2d chip = has(format, wire::ignore_blank) ? fake_chip(*constants, format) : chip_size(*constants);
  if (has(format, wire::vertical)) return FovTerms{chip.y()};
  if (has(format, wire::diagonal)) return FovTerms{std::hypot(chip.x(), chip.y())};
  return FovTerms{chip.x()};
}

Result<double> image_distance_of(double fov, const FovTerms& terms) noexcept {
  if (!std::isfinite(fov)) return tl::unexpected(CameraReason::not_finite);
  double distance = fov;
  if (terms.side > 0) {
    if (!(fov > 0 && fov < 180)) return tl::unexpected(CameraReason::bad_field_of_view);
    distance = terms.side / (2 * std::tan(fov / 2 / degrees_per_radian));
  }
  if (!(distance > 0) || !std::isfinite(distance)) return tl::unexpected(CameraReason::bad_field_of_view);
  return distance;
}

Result<double> fov_of(double distance, const FovTerms& terms) noexcept {
  if (terms.side > 0) return field_of_view(distance, terms.side);
  if (!std::isfinite(distance)) return tl::unexpected(CameraReason::not_finite);
  if (!(distance > 0)) return tl::unexpected(CameraReason::bad_field_of_view);
  return distance;
}

bool operator==(const ShiftTerms& a, const ShiftTerms& b) noexcept {
  return (a.offset == b.offset).all() && (a.scale == b.scale).all();
}

Result<ShiftTerms> shift_terms(std::uint32_t format, const CameraConstants* constants) noexcept {
  ShiftTerms terms;
  const bool in_pixels = has(format, wire::shift_in_pixels);
  const bool ignore_blank = has(format, wire::ignore_blank);
  if (!in_pixels && !ignore_blank) return terms;
  if (const auto known = check_needed(constants); !known) return tl::unexpected(known.error());
  const CameraConstants& c = *constants;
  const Eigen::Array2d pixels_per_mm = picture_size(c) / chip_size(c);
  if (ignore_blank) {
    const Eigen::Array2d asymmetry(static_cast<double>(c.blank_left) - c.blank_right,
                                   static_cast<double>(c.blank_bottom) - c.blank_top);
    terms.offset = asymmetry / (2 * pixels_per_mm);
  }
  if (in_pixels) terms.scale = ignore_blank ? (image_size(c) / fake_chip(c, format)).eval() : pixels_per_mm;
  return terms;
}

Result<Eigen::Vector2d> shift_of(const Eigen::Array2d& center, const ShiftTerms& terms) noexcept {
  const Eigen::Array2d shift = center / terms.scale + terms.offset;
  if (!shift.isFinite().all()) return tl::unexpected(CameraReason::not_finite);
  return shift.matrix();
}

Result<Eigen::Array2d> center_of(const Eigen::Vector2d& shift, const ShiftTerms& terms) noexcept {
  const Eigen::Array2d center = (shift.array() - terms.offset) * terms.scale + 0.0;
  if (!center.isFinite().all()) return tl::unexpected(CameraReason::not_finite);
  return center;
}

/// For equal options: whether numbers mean the same with the terms `a` and `b`. If one of these is unknown, there are
/// no constants, and no receiver can see a difference.
template <typename Terms>
bool same_meaning(const Result<Terms>& a, const Result<Terms>& b) noexcept {
  return !a || !b || *a == *b;
}

Result<double> convert_fov(const wire::CameraParams& params, const LensParts& parts, std::uint32_t format,
                           const CameraConstants* outgoing) noexcept {
  const Result<FovTerms> to = fov_terms(format, outgoing);
  if (fov_options(params.format) == fov_options(format) && same_meaning(parts.fov_terms, to)) return params.fov;
  if (!parts.fov_terms) return tl::unexpected(parts.fov_terms.error());
  if (!to) return tl::unexpected(to.error());
  return parts.image_distance ? fov_of(*parts.image_distance, *to) : parts.image_distance;
}

Result<Eigen::Array2d> convert_shift(const wire::CameraParams& params, const LensParts& parts, std::uint32_t format,
                                     const CameraConstants* outgoing) noexcept {
  const Result<ShiftTerms> to = shift_terms(format, outgoing);
  if (shift_options(params.format) == shift_options(format) && same_meaning(parts.shift_terms, to)) {
    return Eigen::Array2d(params.center_x, params.center_y);
  }
  if (!parts.shift_terms) return tl::unexpected(parts.shift_terms.error());
  if (!to) return tl::unexpected(to.error());
  if (!parts.center_shift) return tl::unexpected(parts.center_shift.error());
  return center_of(*parts.center_shift, *to);
}

}  // namespace

Result<void> check(const CameraConstants& c) noexcept {
  const Eigen::Array4i blanks(c.blank_left, c.blank_right, c.blank_top, c.blank_bottom);
  const bool valid = c.image_width > 0 && c.image_height > 0 && (blanks >= 0).all() && (picture_size(c) > 0).all() &&
                     chip_size(c).isFinite().all() && (chip_size(c) > 0).all() &&
                     (picture_size(c) / chip_size(c)).isFinite().all();
  if (!valid) return tl::unexpected(CameraReason::bad_constants);
  return {};
}

CameraConstants constants_for(const CameraConstants& constants, std::uint32_t format) noexcept {
  CameraConstants outgoing = constants;
  if (!check(constants)) return outgoing;
  const Eigen::Array2d computed = computed_fake_chip(constants, format);
  const Eigen::Array2d known(constants.fake_chip_width, constants.fake_chip_height);
  if (((known - computed).abs() <= chip_tolerance * computed).all()) return outgoing;
  outgoing.fake_chip_width = computed.x();
  outgoing.fake_chip_height = computed.y();
  return outgoing;
}

LensParts lens_parts(const wire::CameraParams& params, const CameraConstants* constants) noexcept {
  LensParts parts{fov_terms(params.format, constants), shift_terms(params.format, constants), 0.0, {}};
  const auto distance = [&params](const FovTerms& terms) { return image_distance_of(params.fov, terms); };
  const auto shift = [&params](const ShiftTerms& terms) { return shift_of({params.center_x, params.center_y}, terms); };
  parts.image_distance = parts.fov_terms.and_then(distance);
  parts.center_shift = parts.shift_terms.and_then(shift);
  return parts;
}

Result<Lens> decode_lens(const wire::CameraParams& params, const LensParts& parts) noexcept {
  // Missing constants are reported first: they may still arrive, while a wrong number stays wrong.
  if (!parts.fov_terms) return tl::unexpected(parts.fov_terms.error());
  if (!parts.shift_terms) return tl::unexpected(parts.shift_terms.error());
  if (!parts.image_distance) return tl::unexpected(parts.image_distance.error());
  if (!parts.center_shift) return tl::unexpected(parts.center_shift.error());
  const Eigen::Array4d rest(params.k1, params.k2, params.focdist, params.aperture);
  if (!rest.isFinite().all()) return tl::unexpected(CameraReason::not_finite);
  return Lens{*parts.image_distance, *parts.center_shift, params.k1, params.k2, params.focdist, params.aperture};
}

Result<Lens> decode_lens(const wire::CameraParams& params, const CameraConstants* constants) noexcept {
  return decode_lens(params, lens_parts(params, constants));
}

Result<void> encode_lens(const Lens& lens, const CameraConstants* constants, wire::CameraParams& params) noexcept {
  const Result<FovTerms> fov = fov_terms(params.format, constants);
  if (!fov) return tl::unexpected(fov.error());
  const Result<ShiftTerms> shift = shift_terms(params.format, constants);
  if (!shift) return tl::unexpected(shift.error());
  const Result<double> written = fov_of(lens.image_distance, *fov);
  if (!written) return tl::unexpected(written.error());
  const Result<Eigen::Array2d> center = center_of(lens.center_shift, *shift);
  if (!center) return tl::unexpected(center.error());
  const Eigen::Array4d rest(lens.k1, lens.k2, lens.focdist, lens.aperture);
  if (!rest.isFinite().all()) return tl::unexpected(CameraReason::not_finite);
  params.fov = *written;
  params.center_x = center->x();
  params.center_y = center->y();
  params.k1 = lens.k1;
  params.k2 = lens.k2;
  params.focdist = lens.focdist;
  params.aperture = lens.aperture;
  return {};
}

Result<void> convert_lens(const wire::CameraParams& params, const LensParts& parts, const CameraConstants* outgoing,
                          wire::CameraParams& out) noexcept {
  const Result<double> fov = convert_fov(params, parts, out.format, outgoing);
  if (!fov) return tl::unexpected(fov.error());
  const Result<Eigen::Array2d> center = convert_shift(params, parts, out.format, outgoing);
  if (!center) return tl::unexpected(center.error());
  out.fov = *fov;
  out.center_x = center->x();
  out.center_y = center->y();
  out.k1 = params.k1;
  out.k2 = params.k2;
  out.focdist = params.focdist;
  out.aperture = params.aperture;
  return {};
}

}  // namespace trk_bridge::camera
