// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The table of schemes.
#pragma once

#include <array>
#include <string>

#include "transport/scheme.h"

namespace trk_bridge::endpoints {

/// All schemes.
const std::array<const transport::Scheme*, 5>& schemes();

/// The beginning of its URLs: "udp://", "shm:", …
std::string prefix_of(const transport::Scheme&);

/// The forms of all URLs: "udp://HOST:PORT, … and file:PATH".
std::string usages();

}  // namespace trk_bridge::endpoints
