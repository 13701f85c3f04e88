// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "scheme.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace trk_bridge::freed {
namespace {

using transport::Direction;
using transport::Option;

constexpr std::string_view no_table = "none";

constexpr std::string_view profile_help = "Meaning of zoom, focus and the spare bytes (generic)";
constexpr std::string_view lens_help = "Lens table: converts encoder counts to a lens, and back";

template <typename Settings>
bool assign_profile(const std::string& value, Settings& settings) {
  return transport::assign(profile_of(value), settings.profile);
}

template <typename Settings>
bool assign_lens(const std::string& value, Settings& settings) {
  settings.lens = value;
  return !value.empty();
}

constexpr std::array<Option<SourceSettings>, 3> source_options{{
    {"profile", profiles_allowed, profile_help, assign_profile<SourceSettings>},
    {"lens", "the path of a lens table and none", lens_help, assign_lens<SourceSettings>},
    {"checksum", "strict and lenient", "lenient: a wrong checksum is a warning (strict)",
     [](const std::string& v, SourceSettings& s) {
       s.lenient = v == "lenient";
       return s.lenient || v == "strict";
     }},
}};

constexpr std::array<Option<SinkSettings>, 3> sink_options{{
    {"profile", profiles_allowed, profile_help, assign_profile<SinkSettings>},
    {"lens", "the path of a lens table and none", lens_help, assign_lens<SinkSettings>},
    {"unwrap", transport::switch_allowed, "0: pan stays within 180 degrees (1)",
     [](const std::string& v, SinkSettings& s) { return transport::assign_switch(v, s.unwrap); }},
}};

std::vector<transport::OptionHelp> options(Direction direction) {
  return direction == Direction::read ? transport::help_of(transport::receive_options, source_options)
                                      : transport::help_of(transport::send_options, sink_options);
}

/// Loads the table that `settings.lens` names.
template <typename Settings>
tl::expected<Settings, std::string> with_table(Settings settings) {
  if (settings.lens.empty() || settings.lens == no_table) return settings;
  auto table = lens::Table::load(settings.lens);
  if (!table) return tl::make_unexpected("option lens: " + table.error());
  settings.table = *std::move(table);
  return settings;
}

const transport::Detection detection{"Free-D", claims,
                                     [] {
                                       std::vector<transport::Detection::Reading> readings(2);
                                       readings[0].decoder = std::make_unique<Decoder>(DecoderOptions{});
                                       DecoderOptions lenient;
                                       lenient.lenient = true;
                                       readings[1] = {"checksum=lenient", std::make_unique<Decoder>(lenient)};
                                       return readings;
                                     },
                                     [] {
                                       return std::vector<transport::UsualPlace>{
                                           {40000, "", "many trackers and heads, Sony"},
                                           {1111, "", "Panasonic"},
                                           {52380, "", "Sony, older"},
                                           {8001, "", "Mo-Sys"},
                                           {6301, "", "stYpe, Ncam"}};
                                     }};

}  // namespace

tl::expected<SourceSettings, std::string> source_settings(const transport::Url& url) {
  SourceSettings settings;
  if (const auto place = transport::set_place(url, settings); !place) return tl::make_unexpected(place.error());
  const auto set = transport::set_options(url, Direction::read, settings, transport::keys_of(options(Direction::write)),
                                          transport::receive_options, source_options);
  if (!set) return tl::make_unexpected(set.error());
  return with_table(std::move(settings));
}

tl::expected<SinkSettings, std::string> sink_settings(const transport::Url& url) {
  SinkSettings settings;
  if (const auto place = transport::set_place(url, settings); !place) return tl::make_unexpected(place.error());
  const bool has_period = std::any_of(url.options.begin(), url.options.end(),
                                      [](const auto& option) { return option.key == "constants_period"; });
  if (has_period) return tl::make_unexpected(std::string("option constants_period: Free-D has no constants to repeat"));
  const auto set = transport::set_options(url, Direction::write, settings, transport::keys_of(options(Direction::read)),
                                          transport::send_options, sink_options);
  if (!set) return tl::make_unexpected(set.error());
  settings.constants_period = 0;
  if (settings.lens.empty() && !sends_lens(settings.profile)) {
    return tl::make_unexpected(std::string(
        "option lens is missing: zoom and focus of this profile are encoder counts, which need a lens table "
        "(lens=FILE.yaml); lens=none sends 0 for both"));
  }
  return with_table(std::move(settings));
}

const transport::Scheme scheme{"freed",
                               "freed://HOST:PORT",
                               "Free-D (type D1) in UDP datagrams",
                               options,
                               [](const transport::Url& url) -> tl::expected<transport::SourceEndpoint, std::string> {
                                 auto settings = source_settings(url);
                                 if (!settings) return tl::make_unexpected(settings.error());
                                 transport::SourceEndpoint endpoint;
                                 endpoint.place = transport::place_of(*settings);
                                 endpoint.over_network = true;
                                 endpoint.open = [settings = *settings](double) {
                                   return transport::open_datagram_source(settings,
                                                                          std::make_unique<Decoder>(settings));
                                 };
                                 return endpoint;
                               },
                               [](const transport::Url& url) -> tl::expected<transport::SinkEndpoint, std::string> {
                                 auto settings = sink_settings(url);
                                 if (!settings) return tl::make_unexpected(settings.error());
                                 transport::SinkEndpoint endpoint;
                                 endpoint.open = [settings = *settings] {
                                   return transport::open_datagram_sink(settings, std::make_unique<Encoder>(settings));
                                 };
                                 return endpoint;
                               },
                               &detection};

}  // namespace trk_bridge::freed
