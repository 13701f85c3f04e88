// A node's private parameters as one tree, read strictly: wrong types and unknown keys are errors.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <xmlrpcpp/XmlRpcValue.h>

namespace trk_bridge::ros1 {

/// The text names the key, the value and what is allowed; one line for every fault.
class ParameterError : public std::runtime_error {
 public:
  explicit ParameterError(const std::vector<std::string>& faults);
};

/// Reads one map of the tree. A key that was asked for is known; refuse_unknown() faults the others. Faults are
/// collected, so that a user sees all of them at once.
class ParameterReader {
 public:
  /// `path` is what keys are prefixed with in errors ("~", "~cameras/crane1/"). Faults go to `faults`, which must
  /// outlive this. A tree that is not a map is a fault and read as an empty one.
  ParameterReader(const XmlRpc::XmlRpcValue& tree, std::string path, std::vector<std::string>& faults);

  /// The value, or none when the key is not given or its type is wrong (a fault).
  std::optional<std::string> text(const std::string& key);
  /// A list of texts; one text is a list of one.
  std::optional<std::vector<std::string>> texts(const std::string& key);
  std::optional<double> number(const std::string& key);  ///< integers are numbers, too
  /// A whole number.
  std::optional<int> integer(const std::string& key);
  /// true or false.
  std::optional<bool> flag(const std::string& key);
  /// A map, for a reader of its own.
  std::optional<XmlRpc::XmlRpcValue> map(const std::string& key);

  /// Makes `key` known without reading it: another reader's.
  void know(const std::string& key);
  /// Whether `key` is given, of whatever type.
  bool has(const std::string& key) const;
  /// Keys that are given, sorted.
  std::vector<std::string> keys() const;
  const std::string& path() const { return path_; }

  /// Makes a fault of every key that is given and was never asked for, with the nearest one that was.
  void refuse_unknown();

 private:
  XmlRpc::XmlRpcValue* find(const std::string& key);
  void wrong_type(const std::string& key, XmlRpc::XmlRpcValue& value, const char* allowed);

  XmlRpc::XmlRpcValue tree_;
  std::string path_;
  std::vector<std::string>& faults_;
  std::vector<std::string> known_;
};

}  // namespace trk_bridge::ros1
