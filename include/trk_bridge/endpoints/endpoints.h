// URLs to sources and sinks: the one place that knows all schemes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/transport/endpoint.h"

namespace trk_bridge::endpoints {

/// Reads a URL to read from. The error names the part, its value and what is allowed; an unknown option's lists the
/// known ones for that scheme and direction. `%XX` in paths and values stands for a byte (needed for `?`, `&`, `%`).
tl::expected<transport::SourceEndpoint, std::string> parse_source(std::string_view url);
/// Reads a URL to write to, likewise. `format=` (words with commas or + between them), `preset=`, `id=`,
/// `delay=` and `lead=` (seconds) are options of every scheme. In the path of a recording, %Y and others stand for the
/// time (file/recording_name.h). Of `default_preset` (its name, or empty), only the options of its scheme count, and
/// only for a URL that says neither format nor preset.
tl::expected<transport::SinkEndpoint, std::string> parse_sink(std::string_view url,
                                                              std::string_view default_preset = {});

/// Reads a URL and opens it: a wrong URL is a TransportError, too. `field_rate` as in SourceEndpoint::open.
std::unique_ptr<transport::Source> open_source(std::string_view url, double field_rate = 50.0);
/// Reads a URL and opens it, likewise.
std::unique_ptr<transport::Sink> open_sink(std::string_view url);

}  // namespace trk_bridge::endpoints
