// Endpoints as help texts, manual page and completion name them, from the table of schemes.
#pragma once

#include <string>
#include <vector>

#include "cli/manual.h"

namespace trk_bridge::tools {

/// How URLs look; the options of every scheme in each direction, and those of every sink.
std::vector<cli::HelpSection> endpoint_help();

/// How URLs begin: "udp://", …
std::vector<std::string> endpoint_prefixes();

}  // namespace trk_bridge::tools
