// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Finds the known word that is nearest to a mistyped one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trk_bridge::base {

/// The candidate with the smallest edit distance to `word`; of several, the first. `candidates` must not be empty.
const std::string& nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The nearest candidate if the word is probably a typing error: at most two edits, and fewer edits than letters.
std::optional<std::string> likely(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trk_bridge::base
