// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The ports and groups to which `trk detect` listens.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace trk_bridge::tools {

/// The place of one socket.
struct DetectPlace {
  std::uint16_t port = 0;
  std::string host;  ///< a group or an address of this machine; empty: every address
  /// `host` is an address of this machine that stands for "every address": URLs omit it.
  bool is_own_address = false;
};
inline bool operator<(const DetectPlace& a, const DetectPlace& b) {
  return std::tie(a.port, a.host) < std::tie(b.port, b.host);
}

/// The places for "7000" or "239.135.1.3:55555"; without any, the usual places of every protocol. A port includes the
/// groups that usually use it. Throws CLI::ValidationError for an invalid text, and TransportError.
std::set<DetectPlace> places_of(const std::vector<std::string>& chosen);

/// The usual places for people: port, protocol, the senders with this default, groups.
std::vector<std::string> usual_place_lines();

}  // namespace trk_bridge::tools
