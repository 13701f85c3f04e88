// The known word that a mistyped one was meant to be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trk_bridge::base {

/// The candidate with the smallest edit distance to `word`, the first of several; `candidates` must not be empty.
const std::string& nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The nearest one where the word is likely to be a slip of it: at most two edits, and not all of it
/// wrong.
std::optional<std::string> likely(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trk_bridge::base
