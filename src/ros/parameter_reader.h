// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads the private parameters of a node in one pass, and reports all faults at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <xmlrpcpp/XmlRpcValue.h>
#include <tl/expected.hpp>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

/// The faults in the parameters of a node.
struct ParameterFaults {
  std::vector<std::string> lines;  ///< each names the key, the value and what is allowed
  std::vector<std::string> given;  ///< keys with refused values on the master, relative to the name of the node
};

/// The text has one line per fault.
class ParameterError : public std::runtime_error {
 public:
  explicit ParameterError(ParameterFaults faults);

  /// The same, with commands that remove the refused parameters from the master: they stay there when the node ends,
  /// and would make the next start fail. `node` is the full name of the node.
  ParameterError with_remedy(const std::string& node) const;

 private:
  ParameterError(ParameterFaults faults, const std::string& remedy);

  ParameterFaults faults_;
};

/// A range of numbers. It never contains infinite values or NaN.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  const char* unit = "";
  bool excludes_least = false;

  bool contains(double value) const noexcept;
  /// "0 to 60 seconds", "0 or more", "more than 0 mm".
  std::string text() const;
};
constexpr Range at_least(double least, const char* unit = "") {
  return {least, std::numeric_limits<double>::infinity(), unit};
}
constexpr Range more_than(double least, const char* unit, double most = std::numeric_limits<double>::infinity()) {
  return {least, most, unit, /*excludes_least=*/true};
}

/// Formats values for fault texts.
std::string shown(const std::string& text);
std::string shown(double number);

/// The error is the reason why this is not a valid name of a camera, from which names of topics and frames are made.
tl::expected<void, std::string> check_camera_name(const std::string&);
/// A frame name that tf accepts.
tl::expected<std::string, std::string> parse_frame(const std::string&);

/// Reads one map of parameters. A function that reads a value does not change `into`, which contains the default, if
/// the key is not given; a wrong value is a fault. It returns whether a value was read. Rules between parameters are
/// checked afterwards: call fault() if a rule is broken and all its parameters are_valid().
class ParameterReader {
 public:
  /// For all private parameters of a node, whose keys begin with "~" in faults. A tree that is not a map is a fault and
  /// treated as empty.
  explicit ParameterReader(const XmlRpc::XmlRpcValue& tree);

  /// Accepts integers as well.
  bool number(const std::string& key, double& into, const Range& = {});
  bool integer(const std::string& key, int& into, const Range& = {});
  /// true or false.
  bool flag(const std::string& key, bool& into);
  /// One of several words.
  template <typename Value>
  bool choice(const std::string& key, Value& into, std::initializer_list<std::pair<const char*, Value>> words);
  /// A text, converted by `parse`: tl::expected<…, std::string>(const std::string&).
  template <typename Value, typename Parse>
  bool parsed(const std::string& key, Value& into, const Parse& parse);
  /// A list of texts, each converted by `parse`; a single text counts as a list with one element.
  template <typename Value, typename Parse>
  bool parsed_list(const std::string& key, std::vector<Value>& into, const Parse& parse);
  /// A camera id, 0 to 4294967295. Integers of the master end at 2147483647: larger ids are texts, or floating-point
  /// numbers, to which rosrun converts them.
  bool id(const std::string& key, std::optional<std::uint32_t>& into);
  /// A map of the ten constants.
  bool constants(const std::string& key, std::optional<wire::CameraConstants>& into);
  /// Checks `diagnostic_period`, seconds, which diagnostic_updater reads.
  void diagnostic_period();
  /// A nested map with its own reader, whose faults are reported together with those of this one.
  std::optional<ParameterReader> map(const std::string& key);
  /// Whether `key` is given as a map or as a text, if other types are allowed, too.
  bool is_map(const std::string& key);
  bool is_text(const std::string& key);

  /// Makes `key` known without reading it.
  void know(const std::string& key);
  /// Whether `key` is given, valid or not.
  bool has(const std::string& key) const;
  /// The given keys, sorted.
  std::vector<std::string> keys() const;

  /// For keys that are not given here, are_valid() asks `outer`, which must outlive this object and its copies.
  void inherit(const ParameterReader& outer) { outer_ = &outer; }
  /// Whether none of these keys has a wrong value: only then a rule between them can be checked.
  bool are_valid(std::initializer_list<const char*> keys) const;
  /// Adds the line "KEY = VALUE: ALLOWED".
  void fault(const std::string& key, const std::string& value, const std::string& allowed);
  /// Adds the line "KEY: TEXT".
  void fault(const std::string& key, const std::string& text);

  /// Adds a line without a key.
  void fault(const std::string& text);

  /// Adds a fault for every unknown key, with the nearest known one.
  void refuse_unknown();
  /// Call at the end: refuses unknown keys, and throws ParameterError if there is any fault.
  void finish();

 private:
  ParameterReader(const XmlRpc::XmlRpcValue& tree, std::string path, std::shared_ptr<ParameterFaults> faults);

  XmlRpc::XmlRpcValue* find(const std::string& key);
  std::optional<std::string> text(const std::string& key, const std::string& allowed);
  std::optional<std::vector<std::string>> texts(const std::string& key);
  bool is_valid(const std::string& key) const;
  bool refuse(const std::string& key, const std::string& value, const std::string& allowed);
  void add_line(const std::string& key, const std::string& line);

  XmlRpc::XmlRpcValue tree_;
  std::string path_;  // prefix of its keys, relative to the name of the node
  std::shared_ptr<ParameterFaults> faults_;
  std::vector<std::string> known_, faulty_;
  const ParameterReader* outer_ = nullptr;
};

/// Adds a fault for an invalid name, which comes from the namespace of the node or is a key of `cameras`.
void check_camera_name(const std::string& name, ParameterReader&);

template <typename Value>
bool ParameterReader::choice(const std::string& key, Value& into,
                             std::initializer_list<std::pair<const char*, Value>> words) {
  std::string allowed = "must be ";
  for (const auto& [word, value] : words) allowed += (&word == &words.begin()->first ? "" : " or ") + std::string(word);
  const auto given = text(key, allowed);
  if (!given) return false;
  const auto found = std::find_if(words.begin(), words.end(), [&](const auto& word) { return *given == word.first; });
  if (found == words.end()) return refuse(key, shown(*given), allowed);
  into = found->second;
  return true;
}

template <typename Value, typename Parse>
bool ParameterReader::parsed(const std::string& key, Value& into, const Parse& parse) {
  const auto given = text(key, "must be text");
  if (!given) return false;
  auto value = parse(*given);
  if (!value) return refuse(key, shown(*given), value.error());
  into = *std::move(value);
  return true;
}

template <typename Value, typename Parse>
bool ParameterReader::parsed_list(const std::string& key, std::vector<Value>& into, const Parse& parse) {
  const auto given = texts(key);
  if (!given) return false;
  std::vector<Value> values;
  for (const auto& one : *given) {
    if (auto value = parse(one)) {
      values.push_back(*std::move(value));
    } else {
      refuse(key, shown(one), value.error());
    }
  }
  if (values.size() < given->size()) return false;
  into = std::move(values);
  return true;
}

}  // namespace trk_bridge::ros1
