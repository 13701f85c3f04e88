// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "scheme.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>

#include "decoder.h"
#include "encoder.h"

namespace trk_bridge::opentrackio {
namespace {

using transport::Direction;
using transport::Option;
using transport::Url;

// The groups of OpenTrackIO 1.0.1 and 1.0.0.
constexpr std::array<std::string_view, 2> groups{"239.135.1.", "235.135.1."};

std::string group_of(std::string_view group, std::uint32_t source) {
  return std::string(group) + std::to_string(source);
}

/// The source number if the host is one of the groups; else 0.
std::uint32_t source_of(std::string_view host) {
  for (const std::string_view group : groups) {
    if (host.substr(0, group.size()) != group) continue;
    return transport::whole_number<std::uint32_t>(host.substr(group.size()), 1, highest_source).value_or(0);
  }
  return 0;
}

constexpr std::string_view offset_allowed = "whole seconds from -1000 to 1000";

bool assign_source(const std::string& value, std::uint32_t& to) {
  return transport::assign(transport::whole_number<std::uint32_t>(value, 1, highest_source), to);
}

bool assign_offset(const std::string& value, int& to) {
  return transport::assign(transport::whole_number(value, -1000, 1000), to);
}

template <typename Value>
struct Word {
  std::string_view word;
  Value value;
};

template <typename Value>
bool assign_word(const std::string& value, const std::array<Word<Value>, 2>& words, Value& to) {
  const auto known = std::find_if(words.begin(), words.end(), [&](const auto& one) { return one.word == value; });
  if (known == words.end()) return false;
  to = known->value;
  return true;
}

constexpr std::array<Word<Encoding>, 2> encodings{{{"json", Encoding::json}, {"cbor", Encoding::cbor}}};
constexpr std::array<Word<Profile>, 2> profiles{{{"generic", Profile::generic}, {"unreal", Profile::unreal}}};
constexpr std::array<Word<Model>, 2> models{
    {{"D-U", Model::distorted_to_undistorted}, {"U-D", Model::undistorted_to_distorted}}};

bool assign_uuid(const std::string& value, std::string& to) {
  constexpr std::string_view form = "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx";
  constexpr std::string_view digits = "0123456789abcdef";
  const bool is_one = std::equal(value.begin(), value.end(), form.begin(), form.end(), [&](char is, char wanted) {
    return wanted == '-' ? is == '-' : digits.find(is) != std::string_view::npos;
  });
  if (is_one) to = "urn:uuid:" + value;
  return is_one;
}

constexpr std::array<Option<SourceSettings>, 2> source_options{{
    {"source", "a source number from 1 to 200, and any",
     "Join the groups of this source, instead of a host; any: accept samples without a valid source number",
     [](const std::string& v, SourceSettings& s) {
       s.takes_any = v == "any";
       return s.takes_any || assign_source(v, s.source);
     }},
    {"tai_offset", offset_allowed, "TAI minus UTC of the clock of the sender, in seconds (37)",
     [](const std::string& v, SourceSettings& s) { return assign_offset(v, s.tai_offset); }},
}};

constexpr std::array<Option<SinkSettings>, 7> sink_options{{
    {"source", "a source number from 1 to 200",
     "Source number in the packets; without a host in the URL, the group of this number is the receiver",
     [](const std::string& v, SinkSettings& s) { return assign_source(v, s.writer.source); }},
    {"encoding", "json and cbor", "Encoding of the samples (json)",
     [](const std::string& v, SinkSettings& s) { return assign_word(v, encodings, s.encoding); }},
    {"profile", "generic and unreal", "What the receiver expects (generic)",
     [](const std::string& v, SinkSettings& s) { return assign_word(v, profiles, s.writer.profile); }},
    {"distortion", "D-U and U-D", "Lens model: distorted to undistorted, or the other way",
     [](const std::string& v, SinkSettings& s) { return assign_word(v, models, s.writer.model); }},
    {"rate", "samples a second from 1 to 1000", "Sample rate to be written in the samples",
     [](const std::string& v, SinkSettings& s) {
       return transport::assign(transport::real_number(v, 1, 1000), s.writer.rate);
     }},
    {"tai_offset", offset_allowed, "TAI minus UTC of the times that are sent, in seconds (37)",
     [](const std::string& v, SinkSettings& s) { return assign_offset(v, s.writer.tai_offset); }},
    {"source_id", "UUIDs with lower-case digits, as in 5e1f0a6c-0000-8000-8000-000000000001",
     "Identity of the source (made from the name of this machine and the target)",
     [](const std::string& v, SinkSettings& s) { return assign_uuid(v, s.source_id); }},
}};

std::vector<transport::OptionHelp> options(Direction direction) {
  return direction == Direction::read
             ? transport::help_of(transport::receive_options, source_options)
             : transport::help_of(transport::send_options, transport::repeat_options, sink_options);
}

bool has_no_host(const Url& url) { return url.place == "//" || url.place.compare(0, 3, "//:") == 0; }

/// The same after every start, because receivers treat another id as another camera.
std::string source_id_of(const SinkSettings& settings) {
  char host[256] = "";
  (void)::gethostname(host, sizeof host - 1);
  const std::string target = settings.host + ":" + std::to_string(settings.port);
  const std::hash<std::string> hash;
  return uuid(hash(host), hash(target));
}

const transport::Detection detection{
    "OpenTrackIO", claims,
    [] {
      const int tai_offset = SourceSettings{}.tai_offset;
      std::vector<transport::Detection::Reading> readings(2);
      readings[0].decoder = std::make_unique<PacketDecoder>(false, tai_offset);
      readings[1] = {"source=any", std::make_unique<PacketDecoder>(true, tai_offset)};
      return readings;
    },
    [] {
      std::vector<transport::UsualPlace> places{{standard_port, "", "unicast"}};
      for (const std::string_view group : groups) {
        for (std::uint32_t source = 1; source <= highest_source; ++source) {
          places.push_back(
              {standard_port, group_of(group, source), group == groups.front() ? "version 1.0.1" : "version 1.0.0"});
        }
      }
      return places;
    }};

}  // namespace

std::vector<transport::ReceiveSettings> SourceSettings::places() const {
  if (source == 0) return {*this};
  std::vector<transport::ReceiveSettings> all;
  for (const std::string_view group : groups) {
    all.emplace_back(*this);
    all.back().host = group_of(group, source);
  }
  return all;
}

tl::expected<SourceSettings, std::string> source_settings(const Url& url) {
  SourceSettings settings;
  if (const auto place = transport::set_place(url, settings, standard_port); !place) {
    return tl::make_unexpected(place.error());
  }
  const auto set = transport::set_options(url, Direction::read, settings, transport::keys_of(options(Direction::write)),
                                          transport::receive_options, source_options);
  if (!set) return tl::make_unexpected(set.error());
  if (settings.source != 0 && !settings.host.empty()) {
    return tl::make_unexpected("option source = \"" + std::to_string(settings.source) +
                               "\": it selects the groups to join, but host \"" + settings.host +
                               "\" is given: remove one of them");
  }
  const std::string named = settings.source != 0 ? "option source = \"" + std::to_string(settings.source) + "\""
                                                 : "host \"" + settings.host + "\"";
  if (settings.source == 0) settings.source = source_of(settings.host);
  if (settings.source != 0 && settings.port == 0) {
    return tl::make_unexpected(named + ": two groups are joined, which need a port other than 0");
  }
  return settings;
}

tl::expected<SinkSettings, std::string> sink_settings(const Url& url) {
  SinkSettings settings;
  // The period that receivers may expect.
  settings.constants_period = 2.0;
  const auto source =
      std::find_if(url.options.begin(), url.options.end(), [](const auto& option) { return option.key == "source"; });
  Url with_host = url;
  // A placeholder that set_place() accepts: the source number is read, and refused if it is invalid, with all other
  // options below.
  if (has_no_host(url) && source != url.options.end()) {
    with_host.place = "//" + group_of(groups.front(), 1) + url.place.substr(2);
  }
  if (const auto place = transport::set_place(with_host, settings, standard_port); !place) {
    return tl::make_unexpected(place.error() + (has_no_host(url) ? ", or source=N for its group" : ""));
  }
  const auto set = transport::set_options(url, Direction::write, settings, transport::keys_of(options(Direction::read)),
                                          transport::send_options, transport::repeat_options, sink_options);
  if (!set) return tl::make_unexpected(set.error());
  if (has_no_host(url)) settings.host = group_of(groups.front(), settings.writer.source);
  if (settings.writer.source == 0) settings.writer.source = source_of(settings.host);
  if (settings.source_id.empty()) settings.source_id = source_id_of(settings);
  return settings;
}

const transport::Scheme scheme{
    "opentrackio",
    "opentrackio://HOST:PORT",
    "OpenTrackIO of SMPTE, in UDP datagrams",
    options,
    [](const Url& url) -> tl::expected<transport::SourceEndpoint, std::string> {
      const auto settings = source_settings(url);
      if (!settings) return tl::make_unexpected(settings.error());
      transport::SourceEndpoint endpoint;
      endpoint.place = transport::place_of(settings->places().front());
      endpoint.over_network = true;
      endpoint.open = [settings = *settings](double) {
        return transport::open_datagram_source(
            settings.places(), std::make_unique<PacketDecoder>(settings.takes_any, settings.tai_offset));
      };
      return endpoint;
    },
    [](const Url& url) -> tl::expected<transport::SinkEndpoint, std::string> {
      const auto settings = sink_settings(url);
      if (!settings) return tl::make_unexpected(settings.error());
      transport::SinkEndpoint endpoint;
      endpoint.open = [settings = *settings] {
        return transport::open_datagram_sink(
            settings, std::make_unique<PacketEncoder>(settings.writer, settings.encoding, settings.source_id));
      };
      return endpoint;
    },
    &detection};

}  // namespace trk_bridge::opentrackio
