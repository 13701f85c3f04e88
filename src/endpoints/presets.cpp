// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "presets.h"

#include <algorithm>
#include <stdexcept>

#include "base/nearest.h"
#include "base/yaml_text.h"
#include "built_in.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::endpoints {
namespace {

using base::YamlFault;
template <typename T>
using Read = base::YamlRead<T>;

Read<std::string> text_of(const base::YamlValue& value) {
  if (value.node.IsScalar() && !value.node.Scalar().empty()) return value.node.Scalar();
  return tl::unexpected(YamlFault{value.mark, value.key + ": must be text"});
}

Read<std::uint32_t> format_of(const base::YamlValue& value) {
  const auto words = text_of(value);
  if (!words) return tl::unexpected(words.error());
  const auto format = wire::format_from_words(*words);
  if (!format) return tl::unexpected(YamlFault{value.mark, value.key + ": " + format.error()});
  return *format;
}

Read<bool> flag_of(const base::YamlValue& value) {
  if (value.node.IsScalar() && value.node.Scalar() == "true") return true;
  if (value.node.IsScalar() && value.node.Scalar() == "false") return false;
  return tl::unexpected(YamlFault{value.mark, value.key + ": must be true or false"});
}

Read<std::string> name_of(const YAML::Node& key) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyz0123456789_";
  const std::string name = key.IsScalar() ? key.Scalar() : "";
  if (!name.empty() && name.find_first_not_of(allowed) == std::string::npos) return name;
  return tl::unexpected(
      YamlFault{key.Mark(), "name of a preset '" + name + "': must be lower-case letters, digits and underscores"});
}

/// Scheme and options, which most presets do not have.
Read<void> read_scheme(const YAML::Node& node, Preset& preset) {
  const auto scheme = base::yaml_value(node, "scheme"), options = base::yaml_value(node, "options");
  if (!scheme.node.IsDefined()) {
    if (!options.node.IsDefined()) return {};
    return tl::unexpected(YamlFault{options.mark, "options: need a scheme"});
  }
  const auto name = text_of(scheme);
  if (!name) return tl::unexpected(name.error());
  preset.scheme = *name;
  if (!options.node.IsDefined()) return {};
  const auto text = text_of(options);
  if (!text) return tl::unexpected(text.error());
  const auto url = transport::split_url(*name + ":?" + *text);
  if (!url) return tl::unexpected(YamlFault{options.mark, "options: " + url.error()});
  preset.options = url->options;
  return {};
}

Read<Preset> preset_of(const std::string& name, const YAML::Node& node) {
  if (!node.IsMap()) return tl::unexpected(YamlFault{node.Mark(), "must be a map of format, sends_id and quirks"});
  const auto checked = base::check_yaml_keys(node, {"format", "sends_id", "quirks"}, {"scheme", "options"});
  if (!checked) return tl::unexpected(checked.error());
  const auto format = format_of(base::yaml_value(node, "format"));
  if (!format) return tl::unexpected(format.error());
  const auto sends_id = flag_of(base::yaml_value(node, "sends_id"));
  if (!sends_id) return tl::unexpected(sends_id.error());
  const auto quirks = text_of(base::yaml_value(node, "quirks"));
  if (!quirks) return tl::unexpected(quirks.error());
  Preset preset{name, *format, *sends_id, *quirks, {}, {}};
  if (const auto read = read_scheme(node, preset); !read) return tl::unexpected(read.error());
  return preset;
}

Read<std::vector<Preset>> presets_of(const YAML::Node& root) {
  if (!root.IsMap()) return tl::unexpected(YamlFault{root.Mark(), "must be a map of presets"});
  std::vector<Preset> known;
  for (const auto& entry : root) {
    const auto name = name_of(entry.first);
    if (!name) return tl::unexpected(name.error());
    if (std::any_of(known.begin(), known.end(), [&](const Preset& preset) { return preset.name == *name; })) {
      return tl::unexpected(YamlFault{entry.first.Mark(), "preset " + *name + " is given twice"});
    }
    auto preset = preset_of(*name, entry.second);
    if (!preset) return tl::unexpected(YamlFault{preset.error().mark, "preset " + *name + ": " + preset.error().what});
    known.push_back(*std::move(preset));
  }
  return known;
}

}  // namespace

tl::expected<std::vector<Preset>, std::string> presets_from_yaml(const std::string& yaml,
                                                                 const std::string& file_name) {
  return base::read_yaml(yaml, file_name, presets_of);
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
