// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Known receivers, by name (config/presets.yaml, which is compiled in).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "transport/scheme.h"

namespace trk_bridge::endpoints {

/// How records are sent to one receiver.
struct Preset {
  std::string name;                           ///< lower-case letters, digits and underscores
  std::uint32_t format = 0;                   ///< wire::FormatBit mask that passes wire::check_writable
  bool sends_id = true;                       ///< false: the receiver does not accept an id; id 0 is sent
  std::string quirks;                         ///< for the user who configures the receiver; one line
  std::string scheme;                         ///< of the sinks that it is for; empty: any that can send trk
  std::vector<transport::UrlOption> options;  ///< defaults for options of such a sink
};

/// The presets of config/presets.yaml, in its order. Any thread. Throws std::runtime_error with the text of
/// presets_from_yaml if the compiled-in file has an error.
const std::vector<Preset>& presets();

/// The error names the nearest preset and lists all. Any thread; throws as presets().
tl::expected<Preset, std::string> find_preset(std::string_view name);

/// Parses `yaml`: a map of names to `format` (words), `sends_id` (true or false) and `quirks` (text), which are
/// required, and for a special scheme `scheme` and `options` (as after the question mark of a URL). The error begins
/// with `file_name` and the line (`presets.yaml:12: …`).
tl::expected<std::vector<Preset>, std::string> presets_from_yaml(const std::string& yaml, const std::string& file_name);

}  // namespace trk_bridge::endpoints
