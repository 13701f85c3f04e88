#include "presets.h"

#include <algorithm>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "base/nearest.h"
#include "built_in.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::endpoints {
namespace {

/// What is wrong, and where.
struct Fault {
  YAML::Mark mark;
  std::string what;
};

template <typename T>
using Read = tl::expected<T, Fault>;

/// A value with the place of its key: an empty value has its own place in the line after.
struct Value {
  std::string key;
  YAML::Mark mark;
  YAML::Node node;
};

/// `map` has the key.
Value value_of(const YAML::Node& map, const std::string& key) {
  const auto entry = std::find_if(map.begin(), map.end(), [&](const auto& one) { return one.first.Scalar() == key; });
  return {key, entry->first.Mark(), entry->second};
}

Read<std::string> text_of(const Value& value) {
  if (value.node.IsScalar() && !value.node.Scalar().empty()) return value.node.Scalar();
  return tl::unexpected(Fault{value.mark, value.key + ": must be text"});
}

Read<std::uint32_t> format_of(const Value& value) {
  const auto words = text_of(value);
  if (!words) return tl::unexpected(words.error());
  const auto format = wire::format_from_words(*words);
  if (!format) return tl::unexpected(Fault{value.mark, value.key + ": " + format.error()});
  return *format;
}

Read<bool> flag_of(const Value& value) {
  if (value.node.IsScalar() && value.node.Scalar() == "true") return true;
  if (value.node.IsScalar() && value.node.Scalar() == "false") return false;
  return tl::unexpected(Fault{value.mark, value.key + ": must be true or false"});
}

Read<std::string> name_of(const YAML::Node& key) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyz0123456789_";
  const std::string name = key.IsScalar() ? key.Scalar() : "";
  if (!name.empty() && name.find_first_not_of(allowed) == std::string::npos) return name;
  return tl::unexpected(
      Fault{key.Mark(), "name of a preset '" + name + "': must be lower-case letters, digits and underscores"});
}

/// Faults keys that are not known, come twice or are missing.
Read<void> check_keys(const YAML::Node& map) {
  const std::vector<std::string> required{"format", "sends_id", "quirks"};
  std::vector<std::string> seen;
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (std::find(required.begin(), required.end(), key) == required.end()) {
      return tl::unexpected(
          Fault{entry.first.Mark(), "no such key '" + key + "', nearest is " + base::nearest(key, required)});
    }
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
      return tl::unexpected(Fault{entry.first.Mark(), key + " is given twice"});
    }
    seen.push_back(key);
  }
  for (const auto& key : required) {
    if (std::find(seen.begin(), seen.end(), key) == seen.end()) {
      return tl::unexpected(Fault{map.Mark(), key + " is missing"});
    }
  }
  return {};
}

Read<Preset> preset_of(const std::string& name, const YAML::Node& node) {
  if (!node.IsMap()) return tl::unexpected(Fault{node.Mark(), "must be a map of format, sends_id and quirks"});
  if (const auto sound = check_keys(node); !sound) return tl::unexpected(sound.error());
  const auto format = format_of(value_of(node, "format"));
  if (!format) return tl::unexpected(format.error());
  const auto sends_id = flag_of(value_of(node, "sends_id"));
  if (!sends_id) return tl::unexpected(sends_id.error());
  const auto quirks = text_of(value_of(node, "quirks"));
  if (!quirks) return tl::unexpected(quirks.error());
  return Preset{name, *format, *sends_id, *quirks};
}

Read<std::vector<Preset>> presets_of(const YAML::Node& root) {
  if (!root.IsMap()) return tl::unexpected(Fault{root.Mark(), "must be a map of presets"});
  std::vector<Preset> known;
  for (const auto& entry : root) {
    const auto name = name_of(entry.first);
    if (!name) return tl::unexpected(name.error());
    if (std::any_of(known.begin(), known.end(), [&](const Preset& preset) { return preset.name == *name; })) {
      return tl::unexpected(Fault{entry.first.Mark(), "preset " + *name + " is given twice"});
    }
    auto preset = preset_of(*name, entry.second);
    if (!preset) return tl::unexpected(Fault{preset.error().mark, "preset " + *name + ": " + preset.error().what});
    known.push_back(*std::move(preset));
  }
  return known;
}

std::string at(const std::string& file_name, const YAML::Mark& mark, const std::string& what) {
  // An empty file has no place for its fault.
  const int line = mark.is_null() ? 1 : mark.line + 1;
  return file_name + ":" + std::to_string(line) + ": " + what;
}

}  // namespace

tl::expected<std::vector<Preset>, std::string> presets_from_yaml(const std::string& yaml,
                                                                 const std::string& file_name) {
  try {
    auto read = presets_of(YAML::Load(yaml));
    if (!read) return tl::unexpected(at(file_name, read.error().mark, read.error().what));
    return *std::move(read);
  } catch (const YAML::Exception& error) {
    return tl::unexpected(at(file_name, error.mark, error.msg));
  }
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> known = [] {
    auto read = presets_from_yaml(built_in, "presets.yaml");
    if (!read) throw std::runtime_error(read.error());
    return *std::move(read);
  }();
  return known;
}

tl::expected<Preset, std::string> find_preset(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& preset : presets()) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  std::string error =
      "no such preset '" + std::string(name) + "', nearest is " + base::nearest(name, names) + "; known are";
  for (const auto& known : names) error += (known == names.front() ? " " : ", ") + known;
  return tl::unexpected(error);
}

}  // namespace trk_bridge::endpoints
