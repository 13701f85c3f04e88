// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The text functions of the C interface, which need no handle: what they read, they can write, and read again.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "c_records.h"
#include "fuzz.h"
#include "trk_struct.h"

namespace trk_bridge::test {

/// Null now and then.
template <typename Value>
Value* or_null(Input& input, Value& value) {
  return input.below(16) == 0 ? nullptr : &value;
}

inline bool is_finite(const trkCameraConstants& c) {
  return std::isfinite(c.chipWidth) && std::isfinite(c.chipHeight) && std::isfinite(c.fakeChipWidth) &&
         std::isfinite(c.fakeChipHeight);
}
inline bool is_finite(const trkCameraParams& p) {
  const double* const m = &p.t.m[0][0];
  const std::ptrdiff_t numbers = (p.format & trkEuler) != 0 ? 6 : 16;
  return std::all_of(m, m + numbers, [](double x) { return std::isfinite(x); }) && std::isfinite(p.fov) &&
         std::isfinite(p.centerX) && std::isfinite(p.centerY) && std::isfinite(p.k1) && std::isfinite(p.k2) &&
         std::isfinite(p.focdist) && std::isfinite(p.aperture);
}

/// Any text, and null in place of any argument.
inline void use_texts(Input& input) {
  const std::string text(input.bytes(input.number<std::uint16_t>() % 800));
  const char* const given = input.below(16) == 0 ? nullptr : text.c_str();
  trkCameraParams params{};
  trkCameraConstants constants{};
  unsigned format = 0;
  const int are_params = trkStringToParams(given, or_null(input, params));
  if (are_params != 0) {
    trkCameraParams again{};
    claim(is_finite(params) && trkStringToParams(text_of(params).c_str(), &again) == 1, "a text that is not read");
    claim(text_of(again) == text_of(params), "another text of the same parameters");
  }
  const int are_constants = trkStringToConstants(given, or_null(input, constants));
  if (are_constants != 0) {
    trkCameraConstants again{};
    claim(trkStringToConstants(text_of(constants).c_str(), &again) == 1 && text_of(again) == text_of(constants),
          "other constants of the same text");
  }
  std::vector<char> words(trkStringSize);
  claim(trkParamsToString(&params, words.data()) == static_cast<int>(std::strlen(words.data())), "a wrong length");
  claim(trkConstantsToString(&constants, words.data()) == static_cast<int>(std::strlen(words.data())),
        "a wrong length");
  if (trkStringToFormat(given, or_null(input, format)) != 0) {
    unsigned again = 0;
    claim(trkFormatToString(format, words.data()) == static_cast<int>(std::strlen(words.data())), "a wrong length");
    claim(trkStringToFormat(words.data(), &again) == 1, "words that are not read");
  }
  trkFormatToString(input.number<std::uint32_t>(), words.data());
  claim(trkParamsToString(nullptr, words.data()) == 0 && words[0] == '\0', "a text of nothing");
  claim(trkParamsToString(&params, nullptr) == 0 && trkFormatToString(0, nullptr) == 0, "a text in nothing");
}

}  // namespace trk_bridge::test
