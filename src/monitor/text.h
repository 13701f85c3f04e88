// The words and numbers of the monitor, in groups, before they are laid out.
#pragma once

#include <string>
#include <vector>

#include "view.h"

namespace trk_bridge::monitor {

/// What belongs together in a line; where a line is too short for it, it goes on in the next.
struct Group {
  std::vector<Span> items;
  std::size_t gap = 2;  ///< spaces between items
};

/// What matters most first.
std::vector<Group> groups_of(const State&);
std::vector<Group> groups_of(const CameraState&);

}  // namespace trk_bridge::monitor
