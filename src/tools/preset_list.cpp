// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "preset_list.h"

#include <ostream>

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::tools {

namespace {

/// Formatted as in a URL.
std::string options_text(const endpoints::Preset& preset) {
  std::string text;
  for (const auto& option : preset.options) text += (text.empty() ? "?" : "&") + option.key + "=" + option.value;
  return text;
}

}  // namespace

void list_presets(const std::vector<endpoints::Preset>& known, std::ostream& out) {
  for (const auto& preset : known) {
    out << preset.name << '\n' << "  sends   " << wire::format_to_words(preset.format);
    out << (preset.sends_id ? "" : "; never an id") << '\n';
    if (!preset.scheme.empty()) out << "  sink    " << preset.scheme << "://HOST:PORT" << options_text(preset) << '\n';
    out << "  quirks  " << preset.quirks << '\n';
  }
}

void list_presets_as_json(const std::vector<endpoints::Preset>& known, std::ostream& out) {
  for (const auto& preset : known) {
    rapidjson::StringBuffer line;
    rapidjson::Writer<rapidjson::StringBuffer> writer(line);
    writer.StartObject();
    writer.Key("name");
    writer.String(preset.name);
    writer.Key("format");
    writer.Uint(preset.format);
    writer.Key("format_words");
    writer.String(wire::format_to_words(preset.format));
    writer.Key("sends_id");
    writer.Bool(preset.sends_id);
    writer.Key("scheme");
    writer.String(preset.scheme);
    writer.Key("options");
    writer.String(options_text(preset));
    writer.Key("quirks");
    writer.String(preset.quirks);
    writer.EndObject();
    out << line.GetString() << '\n';
  }
}

}  // namespace trk_bridge::tools
