// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Sizes and offsets of the binary records (doc/wire_formats.md, "Binary").
#pragma once

#include <cstddef>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::wire {

struct ParamsShape {
  std::size_t format, transform, lens, counter, counter_width, size;
};

struct ConstantsShape {
  std::size_t image, chip, size;
};

inline constexpr std::size_t transform_size = 128;
/// Identified records begin with their id.
inline constexpr std::size_t id_offset = 0;

constexpr ParamsShape params_shape(Generation generation, Abi abi) noexcept {
  ParamsShape s{};
  s.format = generation == Generation::identified ? 4 : 0;
  s.transform = abi == Abi::i386 ? s.format + 4 : 8;
  s.lens = s.transform + transform_size;
  s.counter = s.lens + 7 * sizeof(double);
  s.counter_width = abi == Abi::lp64 ? 8 : 4;
  s.size = s.counter + (abi == Abi::i386 ? 4 : 8);
  return s;
}

constexpr ConstantsShape constants_shape(Generation generation, Abi abi) noexcept {
  ConstantsShape s{};
  s.image = generation == Generation::identified ? 4 : 0;
  s.chip = generation == Generation::identified && abi != Abi::i386 ? 32 : s.image + 24;
  s.size = s.chip + 4 * sizeof(double);
  return s;
}

static_assert(sizeof(double) == 8, "the records hold IEEE doubles");
static_assert(params_shape(Generation::document, Abi::lp64).size == 200);
static_assert(params_shape(Generation::document, Abi::llp64).size == 200);
static_assert(params_shape(Generation::document, Abi::i386).size == 192);
static_assert(params_shape(Generation::identified, Abi::lp64).size == 200);
static_assert(params_shape(Generation::identified, Abi::llp64).size == 200);
static_assert(params_shape(Generation::identified, Abi::i386).size == 196);
static_assert(params_shape(Generation::document, Abi::lp64).lens == 136);
static_assert(params_shape(Generation::document, Abi::lp64).counter == 192);
static_assert(params_shape(Generation::document, Abi::i386).transform == 4);
static_assert(params_shape(Generation::document, Abi::i386).counter == 188);
static_assert(params_shape(Generation::identified, Abi::i386).transform == 8);
static_assert(params_shape(Generation::identified, Abi::i386).counter == 192);
static_assert(constants_shape(Generation::document, Abi::lp64).size == 56);
static_assert(constants_shape(Generation::document, Abi::i386).size == 56);
static_assert(constants_shape(Generation::document, Abi::lp64).chip == 24);
static_assert(constants_shape(Generation::identified, Abi::lp64).size == 64);
static_assert(constants_shape(Generation::identified, Abi::llp64).chip == 32);
static_assert(constants_shape(Generation::identified, Abi::i386).size == 60);
static_assert(constants_shape(Generation::identified, Abi::i386).chip == 28);

}  // namespace trk_bridge::wire
