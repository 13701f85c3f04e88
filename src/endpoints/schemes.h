// The table of schemes.
#pragma once

#include <array>
#include <string>

#include "transport/scheme.h"

namespace trk_bridge::endpoints {

/// Every scheme there is.
const std::array<const transport::Scheme*, 5>& schemes();

/// How their URLs begin: "udp://", "shm:", …
std::string prefix_of(const transport::Scheme&);

/// How their URLs look: "udp://HOST:PORT, … and file:PATH".
std::string usages();

}  // namespace trk_bridge::endpoints
