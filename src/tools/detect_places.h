// Where `trk detect` listens.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace trk_bridge::tools {

/// One socket's.
struct DetectPlace {
  std::uint16_t port = 0;
  std::string host;           ///< a group or an address of this machine; empty: every address
  bool is_every_one = false;  ///< `host` is one of all addresses of this machine
};
inline bool operator<(const DetectPlace& a, const DetectPlace& b) {
  return std::tie(a.port, a.host) < std::tie(b.port, b.host);
}

/// Of "7000" or "239.135.1.3:55555"; without any, the usual places of every protocol. A port comes with the groups that
/// usually use it. Throws CLI::ValidationError for a text that is no place, and TransportError.
std::set<DetectPlace> places_of(const std::vector<std::string>& chosen);

/// The usual places for a person: port, protocol, whose default it is, groups.
std::vector<std::string> usual_place_lines();

}  // namespace trk_bridge::tools
