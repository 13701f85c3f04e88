#include "parameter_reader.h"

#include <algorithm>
#include <sstream>

#include "base/nearest.h"

namespace trk_bridge::ros1 {
namespace {

using XmlRpc::XmlRpcValue;

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const auto& word : words) {
    if (!text.empty()) text += between;
    text += word;
  }
  return text;
}

std::string shown(const XmlRpcValue& value) {
  std::ostringstream out;
  if (value.getType() == XmlRpcValue::TypeString) {
    out << '\'' << value << '\'';
  } else {
    out << value;
  }
  return out.str();
}

}  // namespace

ParameterError::ParameterError(const std::vector<std::string>& faults) : std::runtime_error(joined(faults, "\n")) {}

ParameterReader::ParameterReader(const XmlRpcValue& tree, std::string path, std::vector<std::string>& faults)
    : tree_(tree), path_(std::move(path)), faults_(faults) {
  if (tree_.getType() == XmlRpcValue::TypeStruct) return;
  // An empty map arrives as an invalid value.
  if (tree_.valid()) faults_.push_back(path_ + " = " + shown(tree_) + ": must be a map of parameters");
  tree_.clear();
}

XmlRpcValue* ParameterReader::find(const std::string& key) {
  know(key);
  return has(key) ? &tree_[key] : nullptr;
}

void ParameterReader::know(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
}

bool ParameterReader::has(const std::string& key) const {
  return tree_.getType() == XmlRpcValue::TypeStruct && tree_.hasMember(key);
}

void ParameterReader::wrong_type(const std::string& key, XmlRpcValue& value, const char* allowed) {
  faults_.push_back(path_ + key + " = " + shown(value) + ": must be " + allowed);
}

std::optional<std::string> ParameterReader::text(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeString) return static_cast<std::string&>(*value);
  wrong_type(key, *value, "text");
  return std::nullopt;
}

std::optional<std::vector<std::string>> ParameterReader::texts(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeString) return std::vector{static_cast<std::string&>(*value)};
  bool sound = value->getType() == XmlRpcValue::TypeArray;
  std::vector<std::string> all;
  for (int i = 0; sound && i < value->size(); ++i) {
    auto& one = (*value)[i];
    sound = one.getType() == XmlRpcValue::TypeString;
    if (sound) all.push_back(static_cast<std::string&>(one));
  }
  if (sound) return all;
  wrong_type(key, *value, "a list of texts");
  return std::nullopt;
}

std::optional<double> ParameterReader::number(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeDouble) return static_cast<double&>(*value);
  if (value->getType() == XmlRpcValue::TypeInt) return static_cast<int&>(*value);
  wrong_type(key, *value, "a number");
  return std::nullopt;
}

std::optional<int> ParameterReader::integer(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeInt) return static_cast<int&>(*value);
  wrong_type(key, *value, "an integer");
  return std::nullopt;
}

std::optional<bool> ParameterReader::flag(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeBoolean) return static_cast<bool&>(*value);
  wrong_type(key, *value, "true or false");
  return std::nullopt;
}

std::optional<XmlRpcValue> ParameterReader::map(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeStruct) return *value;
  wrong_type(key, *value, "a map");
  return std::nullopt;
}

std::vector<std::string> ParameterReader::keys() const {
  std::vector<std::string> names;
  if (tree_.getType() != XmlRpcValue::TypeStruct) return names;
  XmlRpcValue tree = tree_;  // iteration is not const
  for (auto& [name, value] : tree) names.push_back(name);
  return names;
}

void ParameterReader::refuse_unknown() {
  for (const auto& key : keys()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    std::sort(known_.begin(), known_.end());
    faults_.push_back(path_ + key + " = " + shown(tree_[key]) + ": no such parameter, nearest is " +
                      base::nearest(key, known_) + "; known are " + joined(known_, ", "));
  }
}

}  // namespace trk_bridge::ros1
