// The known word that a mistyped one was meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trk_bridge::base {

/// The candidate with the smallest edit distance to `word`, the first of several; `candidates` must not be empty.
const std::string& nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trk_bridge::base
