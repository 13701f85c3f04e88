// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk presets`: lists the known receivers.
#pragma once

#include <iosfwd>
#include <vector>

#include "endpoints/presets.h"

namespace trk_bridge::tools {

/// For people: name, format words and quirks of the receiver.
void list_presets(const std::vector<endpoints::Preset>&, std::ostream& out);
/// One JSON object per line: name, format, format_words, sends_id, scheme, options, quirks.
void list_presets_as_json(const std::vector<endpoints::Preset>&, std::ostream& out);

}  // namespace trk_bridge::tools
