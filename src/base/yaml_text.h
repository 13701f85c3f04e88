// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads YAML files written by users, with faults that name the line. For modules that use yaml-cpp.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>
#include <tl/expected.hpp>

#include "nearest.h"

namespace trk_bridge::base {

/// An error and its position.
struct YamlFault {
  YAML::Mark mark;
  std::string what;
};

template <typename T>
using YamlRead = tl::expected<T, YamlFault>;

/// A value with the position of its key, because an empty value has its position in the next line.
struct YamlValue {
  std::string key;
  YAML::Mark mark;
  YAML::Node node;
};

/// The value of a key; its node is undefined if `map` does not have the key.
inline YamlValue yaml_value(const YAML::Node& map, const std::string& key) {
  const auto entry = std::find_if(map.begin(), map.end(), [&](const auto& one) { return one.first.Scalar() == key; });
  if (entry == map.end()) return {key, map.Mark(), YAML::Node(YAML::NodeType::Undefined)};
  return {key, entry->first.Mark(), entry->second};
}

/// Checks for keys that are unknown, given twice or missing.
inline YamlRead<void> check_yaml_keys(const YAML::Node& map, const std::vector<std::string>& required,
                                      const std::vector<std::string>& optional = {}) {
  std::vector<std::string> known = required;
  known.insert(known.end(), optional.begin(), optional.end());
  std::vector<std::string> seen;
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      return tl::unexpected(
          YamlFault{entry.first.Mark(), "no such key '" + key + "', nearest is " + nearest(key, known)});
    }
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
      return tl::unexpected(YamlFault{entry.first.Mark(), key + " is given twice"});
    }
    seen.push_back(key);
  }
  for (const auto& key : required) {
    if (std::find(seen.begin(), seen.end(), key) == seen.end()) {
      return tl::unexpected(YamlFault{map.Mark(), key + " is missing"});
    }
  }
  return {};
}

/// Parses a document and returns `read(root)`. The error begins with `file_name` and the line (`presets.yaml:12: …`).
template <typename Read>
auto read_yaml(const std::string& yaml, const std::string& file_name, const Read& read)
    -> tl::expected<typename decltype(read(YAML::Node()))::value_type, std::string> {
  const auto at = [&](const YAML::Mark& mark, const std::string& what) {
    // The fault of an empty file has no position.
    const int line = mark.is_null() ? 1 : mark.line + 1;
    return tl::make_unexpected(file_name + ":" + std::to_string(line) + ": " + what);
  };
  try {
    auto result = read(YAML::Load(yaml));
    if (!result) return at(result.error().mark, result.error().what);
    return *std::move(result);
  } catch (const YAML::Exception& error) {
    return at(error.mark, error.msg);
  }
}

}  // namespace trk_bridge::base
