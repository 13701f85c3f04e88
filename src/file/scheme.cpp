// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "scheme.h"

#include <array>
#include <string_view>
#include <utility>

#include "base/time_text.h"

namespace trk_bridge::file {
namespace {

using transport::assign;
using transport::assign_switch;
using transport::Direction;
using transport::Option;
using transport::real_number;

constexpr std::array<Option<SourceSettings>, 6> source_options{{
    {"rate", "fields per second from 0.001 to 100000", "Rate of the take (50, or the field rate of the program)",
     [](const std::string& v, SourceSettings& s) { return assign(real_number(v, 1e-3, 1e5), s.rate); }},
    {"speed", "0 (as fast as possible) and a factor from 0.001 to 1000", "Playback speed (1)",
     [](const std::string& v, SourceSettings& s) {
       return assign(real_number(v, 0.0, 1e3), s.speed) && (s.speed == 0.0 || s.speed >= 1e-3);
     }},
    {"loop", transport::switch_allowed, "1: play it repeatedly",
     [](const std::string& v, SourceSettings& s) { return assign_switch(v, s.loop); }},
    {"time", "timecode and now", "Stamps of samples: the time code of the take, or the current time (timecode)",
     [](const std::string& v, SourceSettings& s) {
       s.time = v == "now" ? FileTime::now : FileTime::timecode;
       return v == "now" || v == "timecode";
     }},
    {"date", "a day from 1970-01-01 to 2249-12-31 as YYYY-MM-DD", "Day of the time code, UTC (today)",
     [](const std::string& v, SourceSettings& s) {
       s.date = base::day_from_text(v);
       return s.date && *s.date <= latest_date;
     }},
    {"lenient", transport::switch_allowed, "1: skip malformed lines (otherwise the first one ends the take)",
     [](const std::string& v, SourceSettings& s) { return assign_switch(v, s.lenient); }},
}};

constexpr std::array<Option<SinkSettings>, 4> sink_options{{
    {"timecode", "HH:MM:SS:FF:D, with D 1 or 2 (drop-frame: HH:MM:SS;FF:D)",
     "Time code of the first field (that of the field, else its time of day, UTC)",
     [](const std::string& v, SinkSettings& s) {
       const auto code = base::parse_time_code(v);
       if (code) s.time_code = *code;
       return code.has_value();
     }},
    {"rate", "fields per second from 1 to 200", "Rate of the default time code (50)",
     [](const std::string& v, SinkSettings& s) { return assign(real_number(v, 1, 200), s.rate); }},
    {"number", transport::switch_allowed, "1: add the next free number to the name",
     [](const std::string& v, SinkSettings& s) { return assign_switch(v, s.number); }},
    {"overwrite", transport::switch_allowed, "1: replace a take that exists",
     [](const std::string& v, SinkSettings& s) { return assign_switch(v, s.overwrite); }},
}};

std::vector<transport::OptionHelp> options(Direction direction) {
  return direction == Direction::read ? transport::help_of(source_options) : transport::help_of(sink_options);
}

/// Does not decode %XX.
tl::expected<std::string_view, std::string> path_of(const transport::Url& url) {
  std::string_view place = url.place;
  if (place.substr(0, 2) == "//") {
    place.remove_prefix(2);
    if (place.empty() || place.front() != '/') {
      return tl::make_unexpected("\"" + url.place + "\": file:PATH and file:///PATH are allowed, a host is not");
    }
  }
  if (place.empty()) return tl::make_unexpected(std::string("no path: file:PATH is allowed"));
  return place;
}

/// `read_path` converts the path for the settings.
template <typename Settings, typename ReadPath, typename Table, typename OtherTable>
tl::expected<Settings, std::string> settings_of(const transport::Url& url, Direction direction,
                                                const ReadPath& read_path, const Table& own,
                                                const OtherTable& other_way) {
  const auto place = path_of(url);
  if (!place) return tl::make_unexpected(place.error());
  auto path = read_path(*place);
  if (!path) return tl::make_unexpected("path = " + path.error());
  Settings settings;
  settings.path = *std::move(path);
  const auto set = transport::set_options(url, direction, settings, transport::keys_of(other_way), own);
  if (!set) return tl::make_unexpected(set.error());
  return settings;
}

}  // namespace

tl::expected<SourceSettings, std::string> source_settings(const transport::Url& url) {
  return settings_of<SourceSettings>(url, Direction::read, transport::percent_decoded, source_options, sink_options);
}

tl::expected<SinkSettings, std::string> sink_settings(const transport::Url& url) {
  auto settings = settings_of<SinkSettings>(url, Direction::write, RecordingName::parse, sink_options, source_options);
  if (settings && settings->number && settings->overwrite) {
    return tl::make_unexpected(
        std::string("option overwrite = \"1\": must not be given together with number=1, which finds a free name"));
  }
  return settings;
}

const transport::Scheme scheme{"file",
                               "file:PATH",
                               "Takes: trk as text, one line per video field",
                               options,
                               [](const transport::Url& url) -> tl::expected<transport::SourceEndpoint, std::string> {
                                 auto settings = source_settings(url);
                                 if (!settings) return tl::make_unexpected(settings.error());
                                 transport::SourceEndpoint endpoint;
                                 // Two slashes after the colon begin a host.
                                 const bool needs_host = settings->path.compare(0, 2, "//") == 0;
                                 endpoint.place = (needs_host ? "file://" : "file:") + settings->path;
                                 endpoint.can_wait = settings->speed == 0;
                                 endpoint.open = [settings = *settings](double field_rate) {
                                   return open_source(settings, field_rate);
                                 };
                                 return endpoint;
                               },
                               [](const transport::Url& url) -> tl::expected<transport::SinkEndpoint, std::string> {
                                 auto settings = sink_settings(url);
                                 if (!settings) return tl::make_unexpected(settings.error());
                                 transport::SinkEndpoint endpoint;
                                 endpoint.blocking = transport::Blocking::storage;
                                 endpoint.open = [settings = *settings] { return open_sink(settings); };
                                 return endpoint;
                               }};

}  // namespace trk_bridge::file
