// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "nearest.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace trk_bridge::base {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

const std::string& nearest(std::string_view word, const std::vector<std::string>& candidates) {
  return *std::min_element(candidates.begin(), candidates.end(), [word](const auto& a, const auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
}

std::optional<std::string> likely(std::string_view word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return std::nullopt;
  const std::string& best = nearest(word, candidates);
  const std::size_t edits = edit_distance(word, best);
  if (edits > 2 || edits >= best.size()) return std::nullopt;
  return best;
}

}  // namespace trk_bridge::base
