// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any text as a line of a file: parameters, constants and format words.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "codec_claims.h"
#include "fuzz.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace {

using namespace trk_bridge;

template <class Read>
void claim_record(const Read& read) {
  if (read) test::claim(test::broken_claim_of(*read, {wire::Encoding::ascii, {}}));
}

void claim_format_words(std::string_view text) {
  const auto mask = wire::format_from_words(text);
  if (!mask) return;
  if ((*mask & ~wire::known_format_bits) != 0) test::claim("a bit that no word has");
  const auto again = wire::format_from_words(wire::format_to_words(*mask));
  if (!again || wire::format_to_words(*again) != wire::format_to_words(*mask))
    test::claim("words that do not read back");
}

void claim_layout_word(std::string_view text) {
  const auto choice = wire::layout_choice_from_word(text);
  if (choice && text != "auto" && !choice->generation) test::claim("a layout without its generation");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  claim_record(wire::params_from_text(text));
  claim_record(wire::constants_from_text(text));
  claim_format_words(text);
  claim_layout_word(text);
  return 0;
}
