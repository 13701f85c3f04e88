// `trk presets`: the receivers that are known by name.
#pragma once

#include <iosfwd>
#include <vector>

#include "endpoints/presets.h"

namespace trk_bridge::tools {

/// For a person: name, format words and what to know of the receiver.
void list_presets(const std::vector<endpoints::Preset>&, std::ostream& out);
/// A JSON object a line: name, format, format_words, sends_id, scheme, options, quirks.
void list_presets_as_json(const std::vector<endpoints::Preset>&, std::ostream& out);

}  // namespace trk_bridge::tools
