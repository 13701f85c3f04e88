// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/format.h"

#include <array>
#include <cstdio>
#include <optional>

#include "words.h"

namespace trk_bridge::wire {

namespace {

struct Word {
  std::string_view name;
  std::uint32_t clears, sets;
};

constexpr std::uint32_t angle_bits = vertical | diagonal;

/// In the order of the document (section 6.2).
constexpr std::array<Word, 19> known_words{{{"matrix", euler, 0},
                                            {"euler", 0, euler},
                                            {"camera_to_studio", studio_to_camera, 0},
                                            {"studio_to_camera", 0, studio_to_camera},
                                            {"camera_z_up", camera_y_up, 0},
                                            {"camera_y_up", 0, camera_y_up},
                                            {"studio_z_up", studio_y_up, 0},
                                            {"studio_y_up", 0, studio_y_up},
                                            {"image_distance", field_of_view, 0},
                                            {"field_of_view", 0, field_of_view},
                                            {"horizontal", angle_bits, 0},
                                            {"vertical", angle_bits, vertical},
                                            {"diagonal", angle_bits, diagonal},
                                            {"consider_blank", ignore_blank, 0},
                                            {"ignore_blank", 0, ignore_blank},
                                            {"adjust_aspect", keep_aspect, 0},
                                            {"keep_aspect", 0, keep_aspect},
                                            {"shift_on_chip", shift_in_pixels, 0},
                                            {"shift_in_pixels", 0, shift_in_pixels}}};

std::optional<Word> find(std::string_view name) {
  for (const Word& word : known_words) {
    if (same_word(word.name, name)) return word;
  }
  return std::nullopt;
}

std::string hexadecimal(std::uint32_t mask) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%X", static_cast<unsigned>(mask));
  return text;
}

}  // namespace

std::string format_to_words(std::uint32_t mask) {
  std::string text;
  const auto add = [&text](std::string_view word) {
    if (!text.empty()) text += ' ';
    text += word;
  };
  const auto pick = [&](std::uint32_t bit, std::string_view set, std::string_view clear) {
    add(has(mask, bit) ? set : clear);
  };
  pick(euler, "euler", "matrix");
  if (!has(mask, euler)) {
    pick(studio_to_camera, "studio_to_camera", "camera_to_studio");
    pick(camera_y_up, "camera_y_up", "camera_z_up");
  }
  pick(studio_y_up, "studio_y_up", "studio_z_up");
  pick(field_of_view, "field_of_view", "image_distance");
  if (has(mask, field_of_view)) {
    if (has(mask, vertical)) {
      add("vertical");
    } else {
      pick(diagonal, "diagonal", "horizontal");
    }
  }
  pick(ignore_blank, "ignore_blank", "consider_blank");
  if (has(mask, ignore_blank)) pick(keep_aspect, "keep_aspect", "adjust_aspect");
  pick(shift_in_pixels, "shift_in_pixels", "shift_on_chip");
  return text;
}

tl::expected<std::uint32_t, std::string> format_from_words(std::string_view text) {
  std::uint32_t mask = 0;
  for (std::string_view name = take_word(text); !name.empty(); name = take_word(text)) {
    const std::optional<Word> word = find(name);
    if (!word) {
      std::string error = "'" + std::string(name) + "' is not a format word; allowed are";
      for (const Word& known : known_words) error += ' ' + std::string(known.name);
      return tl::unexpected(error);
    }
    mask = (mask & ~word->clears) | word->sets;
  }
  return mask;
}

tl::expected<void, std::string> check_writable(std::uint32_t mask) {
  if ((mask & ~known_format_bits) != 0) {
    return tl::unexpected("format " + hexadecimal(mask) + " has the unknown bits " +
                          hexadecimal(mask & ~known_format_bits) + "; the known ones are " +
                          hexadecimal(known_format_bits));
  }
  if (has(mask, angle_bits)) {
    return tl::unexpected("format " + hexadecimal(mask) +
                          " has both vertical and diagonal; only one of them is allowed");
  }
  return {};
}

}  // namespace trk_bridge::wire
