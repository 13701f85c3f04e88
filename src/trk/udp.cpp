// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "udp.h"

#include <array>
#include <string_view>
#include <vector>

#include "datagram_decoder.h"
#include "datagram_encoder.h"
#include "transport/datagram.h"

namespace trk_bridge::trk {
namespace {

using transport::Direction;
using transport::Option;

// The layout of all programs in use.
constexpr wire::Layout default_layout{wire::Generation::identified, wire::Abi::lp64, wire::ByteOrder::little};

constexpr std::array<Option<UdpSourceSettings>, 1> source_options{{
    {"layout", transport::layout_allowed, "Layout of binary records (auto: detected for each sender)",
     [](const std::string& v, UdpSourceSettings& s) { return transport::assign_layout(v, s.layout); }},
}};

constexpr std::array<Option<UdpSinkSettings>, 2> sink_options{{
    {"layout", transport::layout_allowed, "Layout of binary records (identified_lp64_le)",
     [](const std::string& v, UdpSinkSettings& s) { return transport::assign_layout(v, s.layout); }},
    {"binary", transport::switch_allowed, "1: binary records instead of ASCII",
     [](const std::string& v, UdpSinkSettings& s) { return transport::assign_switch(v, s.binary); }},
}};

std::vector<transport::OptionHelp> options(Direction direction) {
  return direction == Direction::read
             ? transport::help_of(transport::receive_options, source_options)
             : transport::help_of(transport::send_options, transport::repeat_options, sink_options);
}

const transport::Detection detection{"trk", claims,
                                     [] {
                                       std::vector<transport::Detection::Reading> readings(1);
                                       readings[0].decoder = std::make_unique<DatagramDecoder>(wire::LayoutChoice{});
                                       return readings;
                                     },
                                     [] {
                                       return std::vector<transport::UsualPlace>{
                                           {60005, "", "TrackMen's plugin for Unreal"},
                                           {12000, "", "receivers of a broadcaster"},
                                           {3000, "", "Vizrt's engine"},
                                           {7000, "", "the examples of this package"}};
                                     }};

}  // namespace

tl::expected<UdpSourceSettings, std::string> udp_source_settings(const transport::Url& url) {
  UdpSourceSettings settings;
  if (const auto place = transport::set_place(url, settings); !place) return tl::make_unexpected(place.error());
  const auto set = transport::set_options(url, Direction::read, settings, transport::keys_of(options(Direction::write)),
                                          transport::receive_options, source_options);
  if (!set) return tl::make_unexpected(set.error());
  return settings;
}

tl::expected<UdpSinkSettings, std::string> udp_sink_settings(const transport::Url& url) {
  UdpSinkSettings settings;
  if (const auto place = transport::set_place(url, settings); !place) return tl::make_unexpected(place.error());
  const auto set = transport::set_options(url, Direction::write, settings, transport::keys_of(options(Direction::read)),
                                          transport::send_options, transport::repeat_options, sink_options);
  if (!set) return tl::make_unexpected(set.error());
  if (settings.layout.generation.has_value() && !settings.binary) {
    return tl::make_unexpected(std::string("option layout is for binary records only: add binary=1"));
  }
  return settings;
}

std::unique_ptr<transport::Source> open_udp_source(const UdpSourceSettings& settings) {
  return transport::open_datagram_source(settings, std::make_unique<DatagramDecoder>(settings.layout));
}

std::unique_ptr<transport::Sink> open_udp_sink(const UdpSinkSettings& settings) {
  wire::WireForm form;
  if (settings.binary) form = {wire::Encoding::binary, wire::resolve(settings.layout, default_layout)};
  return transport::open_datagram_sink(settings, std::make_unique<DatagramEncoder>(form));
}

const transport::Scheme udp_scheme{
    "udp",
    "udp://HOST:PORT",
    "trk in UDP datagrams: unicast, broadcast or multicast",
    options,
    [](const transport::Url& url) -> tl::expected<transport::SourceEndpoint, std::string> {
      auto settings = udp_source_settings(url);
      if (!settings) return tl::make_unexpected(settings.error());
      transport::SourceEndpoint endpoint;
      endpoint.place = transport::place_of(*settings);
      endpoint.over_network = true;
      endpoint.open = [settings = *settings](double) { return open_udp_source(settings); };
      return endpoint;
    },
    [](const transport::Url& url) -> tl::expected<transport::SinkEndpoint, std::string> {
      auto settings = udp_sink_settings(url);
      if (!settings) return tl::make_unexpected(settings.error());
      transport::SinkEndpoint endpoint;
      endpoint.open = [settings = *settings] { return open_udp_sink(settings); };
      return endpoint;
    },
    &detection};

}  // namespace trk_bridge::trk
