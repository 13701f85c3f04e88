// What the environment says of the binary records that are made.
#pragma once

#include <optional>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::c_api {

/// TRK_LAYOUT; nothing chosen where it is not set. None, and a line on stderr, for a word that is no layout.
std::optional<wire::LayoutChoice> layout_from_environment();

}  // namespace trk_bridge::c_api
