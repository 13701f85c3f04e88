// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "scheme.h"

#include <array>
#include <string>

#include "segment.h"

namespace trk_bridge::shm {
namespace {

using transport::Direction;
using transport::Option;

constexpr std::array<Option<Settings>, 0> source_options{};
constexpr std::array<Option<Settings>, 3> sink_options{{
    {"layout", transport::layout_allowed, "Layout of a segment that is created (identified_lp64)",
     [](const std::string& v, Settings& s) { return transport::assign_layout(v, s.layout); }},
    {"mode", "octal permissions from 0 to 0777", "Permissions of a segment that is created (0666)",
     [](const std::string& v, Settings& s) {
       return transport::assign(transport::whole_number(v, 0, 0777, 8), s.mode);
     }},
    {"recreate", transport::switch_allowed, "1: replace an existing segment",
     [](const std::string& v, Settings& s) { return transport::assign_switch(v, s.recreate); }},
}};

std::vector<transport::OptionHelp> options(Direction direction) {
  return direction == Direction::read ? transport::help_of(source_options) : transport::help_of(sink_options);
}

template <typename Table, typename OtherTable>
tl::expected<Settings, std::string> settings_of(const transport::Url& url, Direction direction, const Table& own,
                                                const OtherTable& other_way) {
  Settings settings;
  constexpr int last_slot = slot_count - 1;
  if (!transport::assign(transport::whole_number(url.place, 0, last_slot), settings.slot)) {
    return tl::make_unexpected("slot = \"" + url.place + "\": allowed is a whole number from 0 to " +
                               std::to_string(last_slot));
  }
  const auto set = transport::set_options(url, direction, settings, transport::keys_of(other_way), own);
  if (!set) return tl::make_unexpected(set.error());
  return settings;
}

}  // namespace

tl::expected<Settings, std::string> source_settings(const transport::Url& url) {
  return settings_of(url, Direction::read, source_options, sink_options);
}

tl::expected<Settings, std::string> sink_settings(const transport::Url& url) {
  return settings_of(url, Direction::write, sink_options, source_options);
}

const transport::Scheme scheme{"shm",
                               "shm:SLOT",
                               "trk in System V shared memory, slots 0 to 61",
                               options,
                               [](const transport::Url& url) -> tl::expected<transport::SourceEndpoint, std::string> {
                                 const auto settings = source_settings(url);
                                 if (!settings) return tl::make_unexpected(settings.error());
                                 transport::SourceEndpoint endpoint;
                                 endpoint.place = "shm:" + std::to_string(settings->slot);
                                 endpoint.open = [settings = *settings](double) { return open_source(settings); };
                                 return endpoint;
                               },
                               [](const transport::Url& url) -> tl::expected<transport::SinkEndpoint, std::string> {
                                 const auto settings = sink_settings(url);
                                 if (!settings) return tl::make_unexpected(settings.error());
                                 transport::SinkEndpoint endpoint;
                                 endpoint.blocking = transport::Blocking::attaching;
                                 endpoint.open = [settings = *settings] { return open_sink(settings); };
                                 return endpoint;
                               }};

}  // namespace trk_bridge::shm
