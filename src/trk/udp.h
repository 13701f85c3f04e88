// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The scheme udp: trk over UDP.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "transport/datagram.h"
#include "transport/receive_socket.h"
#include "transport/scheme.h"
#include "trk_bridge/wire/layout.h"

namespace trk_bridge::trk {

/// `udp://[host]:port?allow=…&interface=…&buffer=…&layout=…`, to read from.
struct UdpSourceSettings : transport::ReceiveSettings {
  wire::LayoutChoice layout;  ///< of binary records; what is not given is detected
};

/// `udp://host:port?interface=…&ttl=…&constants_period=…&binary=1&layout=…`, to write to.
struct UdpSinkSettings : transport::SendSettings {
  bool binary = false;
  wire::LayoutChoice layout;  ///< of binary records; what is not given is identified, LP64, little-endian
};

/// Errors name the part of the URL, its value and what is allowed.
tl::expected<UdpSourceSettings, std::string> udp_source_settings(const transport::Url&);
tl::expected<UdpSinkSettings, std::string> udp_sink_settings(const transport::Url&);

/// Throw TransportError.
std::unique_ptr<transport::Source> open_udp_source(const UdpSourceSettings&);
std::unique_ptr<transport::Sink> open_udp_sink(const UdpSinkSettings&);

extern const transport::Scheme udp_scheme;

}  // namespace trk_bridge::trk
