// The table of schemes, for programs that need more of them than endpoints.
#pragma once

#include <vector>

#include "transport/scheme.h"

namespace trk_bridge::endpoints {

/// Every scheme there is, in the order of help texts.
std::vector<const transport::Scheme*> all_schemes();

}  // namespace trk_bridge::endpoints
