// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads the layout of written binary records from the environment.
#pragma once

#include <optional>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::c_api {

/// TRK_LAYOUT; an empty choice if it is not set. None, and a line on stderr, for a value that is not a layout.
std::optional<wire::LayoutChoice> layout_from_environment();

}  // namespace trk_bridge::c_api
