// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "datagram.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "interfaces.h"

namespace trk_bridge::transport {
namespace {

constexpr std::string_view interface_allowed = "an address of this machine or an interface's name";

bool assign_interface(const std::string& value, std::string& to) {
  to = value;
  return is_interface_name_or_address(value);
}

bool assign_hosts(const std::string& value, std::vector<std::string>& to) {
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find(',', begin), value.size());
    if (end == begin) return false;
    std::string host = value.substr(begin, end - begin);
    // An IPv6 address may be in brackets, as in the host of a URL.
    if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    if (host.empty()) return false;
    to.push_back(std::move(host));
    begin = end + 1;
  }
  return true;
}

std::string no_host(std::string_view place) {
  return "host \"" + std::string(place) +
         "\": a name, an IPv4 address or [an IPv6 address] and nothing after the port " + "is allowed";
}

struct HostAndPort {
  std::string_view host, port;
  bool has_port = false;
};

tl::expected<HostAndPort, std::string> split_host(std::string_view place) {
  const bool bracketed = !place.empty() && place.front() == '[';
  const std::size_t host_end = bracketed ? place.find(']') : std::min(place.find(':'), place.size());
  if (host_end == std::string_view::npos) {
    return tl::make_unexpected("host \"" + std::string(place) + "\" has a [ without ]");
  }
  HostAndPort parts;
  parts.host = bracketed ? place.substr(1, host_end - 1) : place.substr(0, host_end);
  const std::string_view rest = place.substr(bracketed ? host_end + 1 : host_end);
  parts.has_port = !rest.empty() && rest.front() == ':';
  if (parts.has_port) parts.port = rest.substr(1);
  if (parts.port.find(':') != std::string_view::npos) {
    return tl::make_unexpected("host \"" + std::string(place) + "\": an IPv6 address must be in [ ], as in [::1]:7000");
  }
  if (!parts.has_port && !rest.empty()) return tl::make_unexpected(no_host(place));
  return parts;
}

struct Place {
  std::string host;
  std::uint16_t port = 0;
};

tl::expected<Place, std::string> place_in(const Url& url, Direction direction,
                                          std::optional<std::uint16_t> standard_port) {
  if (url.place.compare(0, 2, "//") != 0) {
    return tl::make_unexpected("\"" + url.place + "\": " + url.scheme + "://HOST:PORT is allowed");
  }
  const std::string_view place = std::string_view(url.place).substr(2);
  const auto parts = split_host(place);
  if (!parts) return tl::make_unexpected(parts.error());
  const auto host = percent_decoded(parts->host);
  if (!host) return tl::make_unexpected("host = " + host.error());
  // After decoding: written as %20, a space is no part of a name either.
  if (host->find_first_of("/ []") != std::string::npos) return tl::make_unexpected(no_host(place));
  if (host->empty() && direction == Direction::write) {
    return tl::make_unexpected("no host: writing needs a host to send to, as in " + url.scheme + "://192.0.2.7:7000");
  }
  if (!parts->has_port && standard_port) return Place{*host, *standard_port};
  if (!parts->has_port) {
    return tl::make_unexpected("no port: there is no standard port, so it must be given (" + url.scheme +
                               "://HOST:PORT)");
  }
  const int lowest = direction == Direction::read ? 0 : 1;
  const auto port = whole_number(parts->port, lowest, 65535);
  if (!port) {
    return tl::make_unexpected("port = \"" + std::string(parts->port) + "\": allowed for " +
                               (direction == Direction::read ? "reading" : "writing") + " is a whole number from " +
                               std::to_string(lowest) + " to 65535");
  }
  return Place{*host, static_cast<std::uint16_t>(*port)};
}

template <typename Settings>
tl::expected<void, std::string> read_place(const Url& url, Direction direction,
                                           std::optional<std::uint16_t> standard_port, Settings& settings) {
  auto place = place_in(url, direction, standard_port);
  if (!place) return tl::make_unexpected(place.error());
  settings.host = std::move(place->host);
  settings.port = place->port;
  return {};
}

}  // namespace

const std::array<Option<ReceiveSettings>, 3> receive_options{{
    {"allow", "addresses separated by commas", "Accept only these senders",
     [](const std::string& v, ReceiveSettings& s) { return assign_hosts(v, s.allow); }},
    {"interface", interface_allowed, "Join multicast groups on this interface",
     [](const std::string& v, ReceiveSettings& s) { return assign_interface(v, s.interface); }},
    {"buffer", "bytes from 1 to 1073741823", "Receive buffer of the kernel (8388608, or as much as it grants)",
     [](const std::string& v, ReceiveSettings& s) { return assign(whole_number(v, 1, 1073741823), s.buffer); }},
}};

const std::array<Option<SendSettings>, 2> send_options{{
    {"interface", interface_allowed, "Send to multicast groups from this interface",
     [](const std::string& v, SendSettings& s) { return assign_interface(v, s.interface); }},
    {"ttl", "a whole number from 0 to 255", "Time to live (TTL): datagrams pass at most TTL - 1 routers",
     [](const std::string& v, SendSettings& s) { return assign(whole_number(v, 0, 255), s.ttl); }},
}};

const std::array<Option<SendSettings>, 1> repeat_options{{
    {"constants_period", "seconds from 0 to 86400", "Repeat constants after this time (1); 0: only when they change",
     [](const std::string& v, SendSettings& s) { return assign(real_number(v, 0.0, 86400.0), s.constants_period); }},
}};

tl::expected<void, std::string> set_place(const Url& url, ReceiveSettings& settings,
                                          std::optional<std::uint16_t> standard_port) {
  return read_place(url, Direction::read, standard_port, settings);
}

tl::expected<void, std::string> set_place(const Url& url, SendSettings& settings,
                                          std::optional<std::uint16_t> standard_port) {
  return read_place(url, Direction::write, standard_port, settings);
}

std::string place_of(const ReceiveSettings& settings) { return udp_url(settings.host, settings.port); }

}  // namespace trk_bridge::transport
