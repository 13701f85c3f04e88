// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "layout_detector.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "bytes.h"
#include "layout_words.h"
#include "payload.h"
#include "rigid.h"
#include "shape.h"
#include "trk_bridge/wire/fields.h"

namespace trk_bridge::wire {

namespace {

/// Ids, masks with bits of future versions and image sizes are below this.
constexpr std::uint32_t small_number = 0x10000;
/// A first word below this, followed by a zero, is more probably the id of a camera than a format.
constexpr std::uint32_t camera_numbers = 16;

/// The layouts of one size that match what the user has given. Of those that differ only in the counter, `layouts` has
/// the first.
struct Candidates {
  std::array<Layout, generations.size() * byte_orders.size()> layouts{};
  std::size_t count = 0;
  bool size_known = false;

  const Layout* begin() const noexcept { return layouts.data(); }
  const Layout* end() const noexcept { return layouts.data() + count; }
  Fault fault_if_none() const noexcept { return {size_known ? Reason::layout_mismatch : Reason::wrong_size}; }
};

template <class T>
bool allows(const std::optional<T>& given, T value) noexcept {
  return !given || *given == value;
}

template <class Size>
Candidates candidates_for(std::size_t size, const LayoutChoice& given, Size size_of) noexcept {
  Candidates found;
  for (const auto& generation : generations) {
    for (const auto& abi : abis) {
      if (size_of(Layout{generation.value, abi.value, {}}) != size) continue;
      found.size_known = true;
      if (!allows(given.generation, generation.value) || !allows(given.abi, abi.value)) continue;
      for (const auto& byte_order : byte_orders) {
        if (!allows(given.byte_order, byte_order.value)) continue;
        found.layouts[found.count++] = {generation.value, abi.value, byte_order.value};
      }
      break;
    }
  }
  return found;
}

/// Whether a camera could have this number. A number that is not finite also counts as plausible: it is reported as
/// another fault. Other bytes, read as a double, seldom look plausible.
bool is_plausible(double value) noexcept {
  // Magnitudes have the same order as their bits. Without branches, because many are checked in a row.
  constexpr auto bits_of = [](double number) { return __builtin_bit_cast(std::uint64_t, number); };
  constexpr std::uint64_t least = bits_of(1e-50) + 1, limit = bits_of(1e12);
  constexpr std::uint64_t infinite = bits_of(std::numeric_limits<double>::infinity());
  const std::uint64_t magnitude = bits_of(value) & ~(std::uint64_t{1} << 63U);
  const bool is_likely = magnitude - least < limit - least;
  const bool is_zero = magnitude == 0, is_not_finite = magnitude >= infinite;
  return is_likely | is_zero | is_not_finite;
}

/// Whether the doubles are plausible for a record of this format. `is_matrix` checks a matrix.
bool transform_fits(std::string_view image, const Layout& layout, std::uint32_t format,
                    bool (*is_matrix)(const std::array<double, 16>&) noexcept) noexcept {
  const ParamsShape shape = params_shape(layout.generation, layout.abi);
  const auto matrix = load_doubles<16>(image.data() + shape.transform, layout.byte_order);
  if (!has(format, euler)) return is_matrix(matrix);
  if (is_rigid(matrix)) return false;
  constexpr std::size_t euler_numbers = 6;
  // Focus and aperture are not checked: senders write infinity in many ways.
  constexpr std::size_t lens_numbers_before_focus = 5;
  const auto lens = load_doubles<lens_numbers_before_focus>(image.data() + shape.lens, layout.byte_order);
  bool plausible = true;
#pragma GCC unroll 6
  for (std::size_t i = 0; i < euler_numbers; ++i) plausible &= is_plausible(matrix[i]);
#pragma GCC unroll 5
  for (const double number : lens) plausible &= is_plausible(number);
  return plausible;
}

constexpr unsigned best_words = 2;
/// How plausible the id and the format are: known bits 2, bits of possible future versions 1, anything else 0.
unsigned words_grade(std::uint32_t id, std::uint32_t format) noexcept {
  if (id >= small_number) return format <= known_format_bits ? 1 : 0;
  if (format <= known_format_bits) return best_words;
  return format < small_number ? 1 : 0;
}

/// The generation that is more probable by the first two words alone: padding is usually zero and not a known mask, and
/// cameras that send the default format have low numbers.
Generation likely_generation(std::uint32_t first, std::uint32_t second) noexcept {
  return second != 0 || first < camera_numbers ? Generation::identified : Generation::document;
}

/// The first words of a parameter image; the id is 0 if the generation has none.
struct Words {
  std::uint32_t first, second, id, format;
};

inline Words words_of(std::string_view image, const Layout& layout) noexcept {
  const auto first = load<std::uint32_t>(image.data(), layout.byte_order);
  const auto second = load<std::uint32_t>(image.data() + 4, layout.byte_order);
  return layout.generation == Generation::identified ? Words{first, second, first, second}
                                                     : Words{first, second, 0, first};
}

/// One way to read a parameter image, and how plausible it is.
struct Reading {
  Layout layout;
  unsigned words = 0;
  bool fits = false;
  bool known = false;  ///< of the generation that the sender is known to use
  unsigned weight = 0;
};

Reading rate(std::string_view image, Layout layout, std::optional<Generation> known,
             std::optional<Layout> seen) noexcept {
  const Words words = words_of(image, layout);
  Reading r{layout};
  r.words = words_grade(words.id, words.format);
  r.fits = transform_fits(image, layout, words.format, is_affine);
  r.known = r.words > 0 && r.fits && known == layout.generation;
  const bool likely = layout.generation == likely_generation(words.first, words.second);
  const bool same_order = seen && seen->byte_order == layout.byte_order;
  const bool little = layout.byte_order == ByteOrder::little;
  // Each term outweighs all that follow.
  r.weight = (r.fits ? 64U : 0U) + (r.known ? 32U : 0U) + r.words * 8U + (likely ? 4U : 0U) + (same_order ? 2U : 0U) +
             (little ? 1U : 0U);
  return r;
}

struct Choice {
  Reading best;
  bool ambiguous = false;  ///< the record is valid in the other generation, too
};

Choice choose(std::string_view image, const Candidates& candidates, std::optional<Generation> known,
              std::optional<Layout> seen) noexcept {
  std::array<Reading, generations.size() * byte_orders.size()> readings;
  std::size_t count = 0, best = 0;
  // Wrong words neither outweigh good ones that fit nor make them ambiguous.
  for (const bool with_good_words : {true, false}) {
    for (const Layout layout : candidates) {
      const Words words = words_of(image, layout);
      if ((words_grade(words.id, words.format) > 0) != with_good_words) continue;
      readings[count] = rate(image, layout, known, seen);
      if (readings[count].weight > readings[best].weight) best = count;
      ++count;
    }
    if (count != 0 && readings[best].fits) break;
  }
  Choice choice{readings[best]};
  for (std::size_t i = 0; i < count; ++i) {
    const bool other = readings[i].layout.generation != choice.best.layout.generation;
    if (other && readings[i].fits && readings[i].words > 0) choice.ambiguous = true;
  }
  return choice;
}

bool is_picture_size(std::int32_t value) noexcept {
  return std::abs(static_cast<std::int64_t>(value)) < std::int64_t{small_number};
}

/// Whether these sides are plausible for an image.
bool is_picture(double width, double height) noexcept {
  constexpr double longest = 8;
  return width > 0 && height > 0 && width <= longest * height && height <= longest * width;
}

bool is_valid(const CameraConstants& c) noexcept {
  bool valid = true;
  for_each_image_field([&valid](const Field&, std::int32_t value) { valid = valid && is_picture_size(value); }, c);
  for_each_chip_field([&valid](const Field&, double value) { valid = valid && is_plausible(value); }, c);
  // Either both sides of a size are 0 or none: if the id is read as the width, one of them is 0.
  return valid && (c.image_width == 0) == (c.image_height == 0) && (c.chip_width == 0) == (c.chip_height == 0);
}

}  // namespace

unsigned params_grade(std::string_view image, Layout layout) noexcept {
  const Words words = words_of(image, layout);
  return transform_fits(image, layout, words.format, is_rigid) ? words_grade(words.id, words.format) : 0;
}

unsigned constants_grade(std::string_view image, Layout layout) noexcept {
  const auto c = constants_from_image(image, layout);
  if (!c || !is_valid(*c)) return 0;
  return is_picture(c->image_width, c->image_height) && is_picture(c->chip_width, c->chip_height) ? 2 : 1;
}

std::uint64_t LayoutDetectorAccess::counter(std::string_view image, Layout& layout, LayoutDetector& detector) noexcept {
  constexpr std::uint64_t most_lost = 0x10000;
  constexpr unsigned half = 32;
  const char* const at = image.data() + params_shape(layout.generation, Abi::lp64).counter;
  const auto wide = load<std::uint64_t>(at, layout.byte_order);
  if (detector.last_wide_counter_) {
    const std::uint64_t last = *detector.last_wide_counter_;
    if (wide >> half == (last >> half) + 1 && wide - last < most_lost) detector.counter_abi_ = Abi::lp64;
  }
  detector.last_wide_counter_ = wide;
  if (wide >> half != 0 && !detector.counter_abi_) detector.counter_abi_ = Abi::llp64;
  const Abi abi = detector.counter_abi_.value_or(Abi::lp64);
  if (layout.abi != abi) layout.abi = abi;
  return abi == Abi::lp64 ? wide : load<std::uint32_t>(at, layout.byte_order);
}

bool LayoutDetectorAccess::read(std::string_view image, LayoutDetector& detector, const Layout& layout,
                                CameraParams& into, DecodedForm& form, Fault& fault) noexcept {
  if (!read_image(image, layout, into, fault)) return false;
  if (!detector.seen_ || *detector.seen_ != layout) detector.seen_ = layout;
  if (!detector.given_.abi && layout.abi != Abi::i386) into.counter = counter(image, *detector.seen_, detector);
  form.form = {Encoding::binary, *detector.seen_};
  form.layout_guessed = false;
  return true;
}

bool LayoutDetectorAccess::params(std::string_view image, LayoutDetector& detector, Record& into, DecodedForm& form,
                                  Fault& fault) noexcept {
  const LayoutChoice& given = detector.given_;
  const auto& known =
      detector.generation_of_constants_ ? detector.generation_of_constants_ : detector.only_possible_generation_;
  CameraParams& params = record_in<CameraParams>(into);

  if (detector.seen_ && known == detector.seen_->generation && params_size(*detector.seen_) == image.size()) {
    const Layout& seen = *detector.seen_;
    const Words words = words_of(image, seen);
    // If it fits, has the known generation, the best words and the last layout, no other reading can outweigh it.
    if (words_grade(words.id, words.format) == best_words && transform_fits(image, seen, words.format, is_affine)) {
      return read(image, detector, seen, params, form, fault);
    }
  }

  const Candidates candidates =
      candidates_for(image.size(), given, [](const Layout& l) { return params_shape(l.generation, l.abi).size; });
  if (candidates.count == 0) {
    fault = candidates.fault_if_none();
    return false;
  }
  const auto [best, ambiguous] = choose(image, candidates, known, detector.seen_);
  if (!best.fits && !given.generation) {
    fault = {Reason::no_valid_layout};
    return false;
  }
  if (!read(image, detector, best.layout, params, form, fault)) return false;
  if (best.words == best_words && !ambiguous) detector.only_possible_generation_ = best.layout.generation;
  const bool same_either_way = params.id == 0 && params.format == 0;
  form.layout_guessed = ambiguous && !best.known && !same_either_way;
  return true;
}

bool LayoutDetectorAccess::constants(std::string_view image, LayoutDetector& detector, Record& into, DecodedForm& form,
                                     Fault& fault) noexcept {
  const LayoutChoice& given = detector.given_;
  const Candidates candidates =
      candidates_for(image.size(), given, [](const Layout& l) { return constants_shape(l.generation, l.abi).size; });
  if (candidates.count == 0) {
    fault = candidates.fault_if_none();
    return false;
  }

  std::optional<Layout> chosen;
  bool valid = false;
  for (const Layout layout : candidates) {
    const auto constants = constants_from_image(image, layout);
    const bool this_valid = constants && is_valid(*constants);
    const bool as_seen = detector.seen_ && detector.seen_->byte_order == layout.byte_order;
    if (!chosen || (this_valid && !valid) || (this_valid == valid && as_seen)) {
      chosen = layout;
      valid = this_valid;
    }
  }
  if (!read_image(image, *chosen, record_in<CameraConstants>(into), fault)) return false;
  if (!valid && !given.generation) {
    fault = {Reason::no_valid_layout};
    return false;
  }

  Layout layout = *chosen;
  if (!given.abi && detector.seen_ && constants_size({layout.generation, detector.seen_->abi}) == image.size()) {
    layout.abi = detector.seen_->abi;
  }
  detector.generation_of_constants_ = layout.generation;
  detector.seen_ = layout;
  form = {{Encoding::binary, layout}};
  return true;
}

}  // namespace trk_bridge::wire
