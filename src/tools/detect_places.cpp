// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "detect_places.h"

#include <ifaddrs.h>
#include <netdb.h>
#include <netinet/in.h>

#include <cerrno>
#include <map>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "base/system_text.h"
#include "endpoints/schemes.h"
#include "transport/datagram.h"

namespace trk_bridge::tools {
namespace {

DetectPlace place_from(const std::string& text) {
  transport::Url url;
  url.scheme = "udp";
  url.place = text.find(':') == std::string::npos ? "//:" + text : "//" + text;
  transport::ReceiveSettings settings;
  const auto place = transport::set_place(url, settings);
  if (!place || settings.port == 0) {
    throw CLI::ValidationError("PORT = \"" + text +
                               "\": must be 1 to 65535, or a group with a port, such as 239.135.1.1:55555");
  }
  return {settings.port, settings.host};
}

std::vector<transport::UsualPlace> usual_places() {
  std::vector<transport::UsualPlace> all;
  for (const auto* scheme : endpoints::schemes()) {
    if (scheme->detection == nullptr) continue;
    for (auto& place : scheme->detection->places()) all.push_back(std::move(place));
  }
  return all;
}

std::vector<std::string> own_addresses() {
  std::vector<std::string> all;
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) {
    throw transport::TransportError("the addresses of this machine: " + base::system_text(errno));
  }
  for (const ifaddrs* one = list; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr) continue;
    const int family = one->ifa_addr->sa_family;
    if (family != AF_INET && family != AF_INET6) continue;
    const auto size = static_cast<socklen_t>(family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6));
    char text[NI_MAXHOST];
    if (::getnameinfo(one->ifa_addr, size, text, sizeof text, nullptr, 0, NI_NUMERICHOST) == 0) all.emplace_back(text);
  }
  ::freeifaddrs(list);
  return all;
}

/// Adds a port with its usual groups. A socket that is bound to all addresses would keep the kernel from delivering a
/// group to another socket: so, if there are groups, each address of this machine gets a socket.
void add_with_groups(std::uint16_t port, const std::vector<transport::UsualPlace>& usual,
                     std::set<DetectPlace>& places) {
  bool has_groups = false;
  for (const auto& place : usual) {
    if (place.port != port || place.group.empty()) continue;
    has_groups = true;
    places.insert({port, place.group});
  }
  if (!has_groups) {
    places.insert({port, ""});
    return;
  }
  for (auto& address : own_addresses()) places.insert({port, std::move(address), true});
}

}  // namespace

std::set<DetectPlace> places_of(const std::vector<std::string>& chosen) {
  const auto usual = usual_places();
  std::set<DetectPlace> places;
  for (const auto& text : chosen) {
    DetectPlace place = place_from(text);
    if (place.host.empty()) {
      add_with_groups(place.port, usual, places);
    } else {
      places.insert(std::move(place));
    }
  }
  if (!chosen.empty()) return places;
  for (const auto& place : usual) add_with_groups(place.port, usual, places);
  return places;
}

std::vector<std::string> usual_place_lines() {
  std::vector<std::string> lines;
  for (const auto* scheme : endpoints::schemes()) {
    if (scheme->detection == nullptr) continue;
    // Numbered groups are shown in one line: the first and the last.
    std::map<std::string_view, std::vector<transport::UsualPlace>> by_senders;
    std::vector<std::string_view> order;
    for (auto& place : scheme->detection->places()) {
      auto& same = by_senders[place.senders];
      if (same.empty()) order.push_back(place.senders);
      same.push_back(std::move(place));
    }
    for (const auto senders : order) {
      const auto& same = by_senders[senders];
      std::string line = std::to_string(same.front().port) + "  " + std::string(scheme->detection->protocol) + "  " +
                         std::string(senders);
      if (!same.front().group.empty()) line += "  " + same.front().group + " to " + same.back().group;
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace trk_bridge::tools
