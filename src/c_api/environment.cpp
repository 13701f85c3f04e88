// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "environment.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "transport/scheme.h"

namespace trk_bridge::c_api {

std::optional<wire::LayoutChoice> layout_from_environment() {
  const char* const word = std::getenv("TRK_LAYOUT");
  if (word == nullptr) return wire::LayoutChoice{};
  const auto choice = wire::layout_choice_from_word(word);
  if (!choice) {
    const std::string allowed(transport::layout_allowed);
    std::fprintf(stderr, "libtrk: TRK_LAYOUT=%s: allowed are %s\n", word, allowed.c_str());
  }
  return choice;
}

}  // namespace trk_bridge::c_api
