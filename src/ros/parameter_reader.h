// A node's private parameters, read in one pass: every fault is found, and all are shown at once.
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

/// What is wrong with a node's parameters.
struct ParameterFaults {
  std::vector<std::string> lines;  ///< each names the key, the value and what is allowed
  std::vector<std::string> given;  ///< keys whose values are on the master and refused, relative to the node's name
};

/// The text has one line for every fault.
class ParameterError : public std::runtime_error {
 public:
  explicit ParameterError(ParameterFaults faults);

  /// The same, and how to remove from the master what is refused: it stays there when the node ends, and would make the
  /// next start fail. `node` is the node's full name.
  ParameterError with_remedy(const std::string& node) const;

 private:
  ParameterError(ParameterFaults faults, const std::string& remedy);

  ParameterFaults faults_;
};

/// The values that a number may have. Infinite ones and NaN are in no range.
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

/// Values as faults show them.
std::string shown(const std::string& text);
std::string shown(double number);

/// Why a camera cannot be called this, if it cannot: topics and frames are named after it.
tl::expected<void, std::string> check_camera_name(const std::string&);
/// What tf accepts as a frame.
tl::expected<std::string, std::string> parse_frame(const std::string&);

/// Reads one map of parameters. Every function that reads a value leaves `into` as it is, which is the default, where
/// the key is not given; where it is given and wrong, that is a fault. They return whether a value was read. Rules
/// between parameters come after that: fault() where a rule is broken and all its parameters are_sound().
class ParameterReader {
 public:
  /// Of all private parameters of a node, whose keys begin with "~" in faults. A tree that is not a map is a fault and
  /// read as an empty one.
  explicit ParameterReader(const XmlRpc::XmlRpcValue& tree);

  /// Integers are numbers, too.
  bool number(const std::string& key, double& into, const Range& = {});
  bool integer(const std::string& key, int& into, const Range& = {});
  /// true or false.
  bool flag(const std::string& key, bool& into);
  /// One of some words.
  template <typename Value>
  bool choice(const std::string& key, Value& into, std::initializer_list<std::pair<const char*, Value>> words);
  /// A text, kept as what `parse` makes of it: tl::expected<…, std::string>(const std::string&).
  template <typename Value, typename Parse>
  bool parsed(const std::string& key, Value& into, const Parse& parse);
  /// A list of texts, each kept parsed; one text is a list of one.
  template <typename Value, typename Parse>
  bool parsed_list(const std::string& key, std::vector<Value>& into, const Parse& parse);
  /// A camera's number, 0 to 4294967295. Integers of the master end at 2147483647: larger ones are texts, or numbers
  /// with a point, which rosrun makes of them.
  bool id(const std::string& key, std::optional<std::uint32_t>& into);
  /// A map of the ten constants.
  bool constants(const std::string& key, std::optional<wire::CameraConstants>& into);
  /// Checks `diagnostic_period`, seconds, which diagnostic_updater reads itself.
  void diagnostic_period();
  /// A map, for a reader of its own; its faults are shown with this one's.
  std::optional<ParameterReader> map(const std::string& key);
  /// Whether `key` is given as a map, or as a text, where it may be something else as well.
  bool is_map(const std::string& key);
  bool is_text(const std::string& key);

  /// Makes `key` known without reading it.
  void know(const std::string& key);
  /// Whether `key` is given, sound or not.
  bool has(const std::string& key) const;
  /// Keys that are given, sorted.
  std::vector<std::string> keys() const;

  /// Where keys are not given here, are_sound() asks `outer`, which must outlive this and its copies.
  void inherit(const ParameterReader& outer) { outer_ = &outer; }
  /// Whether none of these keys has a wrong value of its own: only then a rule between them can be judged.
  bool are_sound(std::initializer_list<const char*> keys) const;
  /// Adds the line "KEY = VALUE: ALLOWED".
  void fault(const std::string& key, const std::string& value, const std::string& allowed);
  /// Adds the line "KEY: TEXT".
  void fault(const std::string& key, const std::string& text);

  /// Adds a line that is about no key.
  void fault(const std::string& text);

  /// Makes a fault of every key that is given and not known, with the nearest one that is.
  void refuse_unknown();
  /// The end of reading: refuses what is unknown, and throws ParameterError when there is any fault.
  void finish();

 private:
  ParameterReader(const XmlRpc::XmlRpcValue& tree, std::string path, std::shared_ptr<ParameterFaults> faults);

  XmlRpc::XmlRpcValue* find(const std::string& key);
  std::optional<std::string> text(const std::string& key, const std::string& allowed);
  std::optional<std::vector<std::string>> texts(const std::string& key);
  bool is_sound(const std::string& key) const;
  bool refuse(const std::string& key, const std::string& value, const std::string& allowed);
  void add_line(const std::string& key, const std::string& line);

  XmlRpc::XmlRpcValue tree_;
  std::string path_;  // of its keys, relative to the node's name
  std::shared_ptr<ParameterFaults> faults_;
  std::vector<std::string> known_, faulty_;
  const ParameterReader* outer_ = nullptr;
};

/// Adds a fault for a name that is none: it comes from the node's namespace, or is a key of `cameras`.
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
