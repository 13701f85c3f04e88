// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "parameter_reader.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/nearest.h"
#include "base/number_text.h"
#include "trk_bridge/camera/camera.h"

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

std::string text_of(const XmlRpcValue& value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  if (value.getType() == XmlRpcValue::TypeString) {
    out << '\'';
    value.write(out);
    out << '\'';
  } else {
    value.write(out);
  }
  return out.str();
}

/// A fault is one line of a C string, whatever text is given: control characters become "\n", "\t" or "\x00".
std::string as_one_line(const std::string& text) {
  constexpr const char* digits = "0123456789abcdef";
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '\n') {
      line += "\\n";
    } else if (c == '\t') {
      line += "\\t";
    } else if (code < 0x20 || code == 0x7f) {
      line += std::string("\\x") + digits[code / 16] + digits[code % 16];
    } else {
      line += c;
    }
  }
  return line;
}

bool contains(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::optional<std::uint32_t> id_of(XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeString) {
    const auto& text = static_cast<const std::string&>(value);
    std::uint32_t id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (error == std::errc() && end == text.data() + text.size()) return id;
    return std::nullopt;
  }
  double number = -1;
  if (value.getType() == XmlRpcValue::TypeInt) number = static_cast<int&>(value);
  if (value.getType() == XmlRpcValue::TypeDouble) number = static_cast<double&>(value);
  constexpr Range range{0, std::numeric_limits<std::uint32_t>::max()};
  if (!range.contains(number) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

}  // namespace

ParameterError::ParameterError(ParameterFaults faults) : ParameterError(std::move(faults), "") {}

ParameterError::ParameterError(ParameterFaults faults, const std::string& remedy)
    : std::runtime_error(joined(faults.lines, "\n") + remedy), faults_(std::move(faults)) {}

ParameterError ParameterError::with_remedy(const std::string& node) const {
  if (faults_.given.empty()) return *this;
  std::string remedy = "\nParameters stay on the master when a node ends. To remove those that are refused:";
  for (const auto& key : faults_.given) remedy += "\n  rosparam delete " + node + '/' + key;
  return {faults_, remedy};
}

bool Range::contains(double value) const noexcept {
  return std::isfinite(value) && (excludes_least ? value > least : value >= least) && value <= most;
}

std::string Range::text() const {
  std::string text;
  if (std::isinf(least) && std::isinf(most)) {
    text = "finite";
  } else if (excludes_least) {
    text = "more than " + shown(least);
    if (std::isfinite(most)) text += " and at most " + shown(most);
  } else {
    text = shown(least) + (std::isfinite(most) ? " to " + shown(most) : std::string(" or more"));
  }
  if (*unit != '\0') text += std::string(" ") + unit;
  return text;
}

std::string shown(const std::string& text) { return '\'' + text + '\''; }

std::string shown(double number) { return base::general_text(number); }

tl::expected<void, std::string> check_camera_name(const std::string& name) {
  bool valid = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  for (const char c : name) valid = valid && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_');
  if (valid) return {};
  return tl::make_unexpected(std::string("a camera's name must begin with a letter, then letters, digits and _"));
}

tl::expected<std::string, std::string> parse_frame(const std::string& frame) {
  bool valid = !frame.empty() && frame[0] != '/';
  for (const char c : frame) valid = valid && std::isspace(static_cast<unsigned char>(c)) == 0;
  if (valid) return frame;
  return tl::make_unexpected(std::string("must be a tf frame: not empty, no leading slash, no white space"));
}

ParameterReader::ParameterReader(const XmlRpcValue& tree)
    : ParameterReader(tree, "", std::make_shared<ParameterFaults>()) {}

ParameterReader::ParameterReader(const XmlRpcValue& tree, std::string path, std::shared_ptr<ParameterFaults> faults)
    : tree_(tree), path_(std::move(path)), faults_(std::move(faults)) {
  if (tree_.getType() == XmlRpcValue::TypeStruct) return;
  // An empty map arrives as an invalid value.
  if (tree_.valid()) fault('~' + path_ + " = " + text_of(tree_) + ": must be a map of parameters");
  tree_.clear();
}

XmlRpcValue* ParameterReader::find(const std::string& key) {
  know(key);
  return has(key) ? &tree_[key] : nullptr;
}

void ParameterReader::know(const std::string& key) {
  if (!contains(known_, key)) known_.push_back(key);
}

bool ParameterReader::has(const std::string& key) const {
  return tree_.getType() == XmlRpcValue::TypeStruct && tree_.hasMember(key);
}

std::vector<std::string> ParameterReader::keys() const {
  std::vector<std::string> names;
  if (tree_.getType() != XmlRpcValue::TypeStruct) return names;
  for (const auto& [name, value] : tree_) names.push_back(name);
  return names;
}

bool ParameterReader::is_valid(const std::string& key) const {
  if (outer_ != nullptr && !has(key)) return outer_->is_valid(key);
  return !contains(faulty_, key);
}

bool ParameterReader::are_valid(std::initializer_list<const char*> keys) const {
  return std::all_of(keys.begin(), keys.end(), [this](const char* key) { return is_valid(key); });
}

void ParameterReader::fault(const std::string& key, const std::string& value, const std::string& allowed) {
  add_line(key, key + " = " + value + ": " + allowed);
}

void ParameterReader::fault(const std::string& key, const std::string& text) { add_line(key, key + ": " + text); }

void ParameterReader::fault(const std::string& text) { faults_->lines.push_back(as_one_line(text)); }

void ParameterReader::add_line(const std::string& key, const std::string& line) {
  fault('~' + path_ + line);
  auto& given = faults_->given;
  if (has(key) && !contains(given, path_ + key)) given.push_back(path_ + key);
}

bool ParameterReader::refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  fault(key, value, allowed);
  faulty_.push_back(key);
  return false;
}

std::optional<std::string> ParameterReader::text(const std::string& key, const std::string& allowed) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeString) return static_cast<std::string&>(*value);
  refuse(key, text_of(*value), allowed);
  return std::nullopt;
}

std::optional<std::vector<std::string>> ParameterReader::texts(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeString) return std::vector{static_cast<std::string&>(*value)};
  bool valid = value->getType() == XmlRpcValue::TypeArray;
  std::vector<std::string> all;
  for (int i = 0; valid && i < value->size(); ++i) {
    auto& one = (*value)[i];
    valid = one.getType() == XmlRpcValue::TypeString;
    if (valid) all.push_back(static_cast<std::string&>(one));
  }
  if (valid) return all;
  refuse(key, text_of(*value), "must be a list of texts");
  return std::nullopt;
}

bool ParameterReader::number(const std::string& key, double& into, const Range& range) {
  auto* value = find(key);
  if (value == nullptr) return false;
  const bool is_integer = value->getType() == XmlRpcValue::TypeInt;
  if (!is_integer && value->getType() != XmlRpcValue::TypeDouble)
    return refuse(key, text_of(*value), "must be a number");
  const double given = is_integer ? static_cast<int&>(*value) : static_cast<double&>(*value);
  if (!range.contains(given)) return refuse(key, text_of(*value), "must be " + range.text());
  into = given;
  return true;
}

bool ParameterReader::integer(const std::string& key, int& into, const Range& range) {
  auto* value = find(key);
  if (value == nullptr) return false;
  if (value->getType() != XmlRpcValue::TypeInt) return refuse(key, text_of(*value), "must be an integer");
  const int given = static_cast<int&>(*value);
  if (!range.contains(given)) return refuse(key, text_of(*value), "must be " + range.text());
  into = given;
  return true;
}

bool ParameterReader::flag(const std::string& key, bool& into) {
  auto* value = find(key);
  if (value == nullptr) return false;
  if (value->getType() != XmlRpcValue::TypeBoolean) return refuse(key, text_of(*value), "must be true or false");
  into = static_cast<bool&>(*value);
  return true;
}

bool ParameterReader::id(const std::string& key, std::optional<std::uint32_t>& into) {
  auto* value = find(key);
  if (value == nullptr) return false;
  if (const auto given = id_of(*value)) {
    into = *given;
    return true;
  }
  return refuse(key, text_of(*value), "must be an integer, 0 to 4294967295; above 2147483647 as text: \"4294967295\"");
}

bool ParameterReader::constants(const std::string& key, std::optional<wire::CameraConstants>& into) {
  auto reader = map(key);
  if (!reader) return false;
  wire::CameraConstants given;
  reader->integer("image_width", given.image_width);
  reader->integer("image_height", given.image_height);
  reader->integer("blank_left", given.blank_left);
  reader->integer("blank_right", given.blank_right);
  reader->integer("blank_top", given.blank_top);
  reader->integer("blank_bottom", given.blank_bottom);
  reader->number("chip_width", given.chip_width);
  reader->number("chip_height", given.chip_height);
  reader->number("fake_chip_width", given.fake_chip_width);
  reader->number("fake_chip_height", given.fake_chip_height);
  bool complete = true;
  for (const char* needed : {"image_width", "image_height", "chip_width", "chip_height"}) {
    if (reader->has(needed)) continue;
    reader->fault(needed, "must be given (blanks and fake chip are optional)");
    complete = false;
  }
  reader->refuse_unknown();
  if (!complete || !reader->faulty_.empty()) {
    faulty_.push_back(key);
    return false;
  }
  if (const auto checked = camera::check(given); !checked) {
    return refuse(key, text_of(tree_[key]), camera::describe(checked.error()));
  }
  into = given;
  return true;
}

void check_camera_name(const std::string& name, ParameterReader& reader) {
  if (const auto checked = check_camera_name(name); !checked) {
    reader.fault("camera name " + shown(name) + " (from the namespace or the map cameras): " + checked.error());
  }
}

void ParameterReader::diagnostic_period() {
  double period = 1;
  number("diagnostic_period", period, more_than(0, "seconds"));
}

std::optional<ParameterReader> ParameterReader::map(const std::string& key) {
  auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->valid() && value->getType() != XmlRpcValue::TypeStruct) {
    refuse(key, text_of(*value), "must be a map");
    return std::nullopt;
  }
  return ParameterReader(*value, path_ + key + "/", faults_);
}

bool ParameterReader::is_map(const std::string& key) {
  const auto* value = find(key);
  return value != nullptr && value->getType() == XmlRpcValue::TypeStruct;
}

bool ParameterReader::is_text(const std::string& key) {
  const auto* value = find(key);
  return value != nullptr && value->getType() == XmlRpcValue::TypeString;
}

void ParameterReader::refuse_unknown() {
  std::sort(known_.begin(), known_.end());
  for (const auto& key : keys()) {
    if (contains(known_, key)) continue;
    fault(key, text_of(tree_[key]),
          "unknown parameter, nearest is " + base::nearest(key, known_) + "; known are " + joined(known_, ", "));
  }
}

void ParameterReader::finish() {
  refuse_unknown();
  if (!faults_->lines.empty()) throw ParameterError(*faults_);
}

}  // namespace trk_bridge::ros1
