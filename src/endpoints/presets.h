// Receivers known from the field, by name (config/presets.yaml, which is built in).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "transport/scheme.h"

namespace trk_bridge::endpoints {

/// How records are expressed for one receiver.
struct Preset {
  std::string name;                           ///< lower-case letters, digits and underscores
  std::uint32_t format = 0;                   ///< wire::FormatBit mask that passes wire::check_writable
  bool sends_id = true;                       ///< false: the receiver cannot take an id, what is sent has id 0
  std::string quirks;                         ///< for the person who sets up the receiver; one line
  std::string scheme;                         ///< of sinks that it is for; empty: any that carries trk
  std::vector<transport::UrlOption> options;  ///< of such a sink, where its URL does not say otherwise
};

/// Those of config/presets.yaml, in its order. Any thread. Throws std::runtime_error with the text of
/// presets_from_yaml when the file was built in with an error in it.
const std::vector<Preset>& presets();

/// The error names the nearest preset and lists all of them. Any thread; throws as presets().
tl::expected<Preset, std::string> find_preset(std::string_view name);

/// Reads `yaml`: a map of names to `format` (words), `sends_id` (true or false) and `quirks` (text), all of them
/// required, and for a scheme of its own `scheme` and `options` (as behind the question mark of a URL). The error
/// begins with `file_name` and the line (`presets.yaml:12: …`).
tl::expected<std::vector<Preset>, std::string> presets_from_yaml(const std::string& yaml, const std::string& file_name);

}  // namespace trk_bridge::endpoints
