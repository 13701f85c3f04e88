// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The text about endpoints for help, manual page and completion, from the table of schemes.
#pragma once

#include <string>
#include <vector>

#include "cli/manual.h"

namespace trk_bridge::tools {

/// The syntax of URLs, the options of every scheme in each direction, and those of every sink.
std::vector<cli::HelpSection> endpoint_help();

/// The beginnings of URLs: "udp://", …
std::vector<std::string> endpoint_prefixes();

}  // namespace trk_bridge::tools
