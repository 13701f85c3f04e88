// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Sources and sinks from URLs. Only this module knows all schemes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/transport/endpoint.h"

namespace trk_bridge::endpoints {

/// Parses the URL of a source. The error names the part, its value and what is allowed; for an unknown option it lists
/// the known ones of that scheme and direction. `%XX` in paths and values stands for a byte (needed for `?`, `&`, `%`).
tl::expected<transport::SourceEndpoint, std::string> parse_source(std::string_view url);
/// Parses the URL of a sink. Every scheme has the options `format=` (words separated by commas or +), `preset=`, `id=`,
/// `delay=` and `lead=` (seconds). In the path of a recording, %Y and others stand for the time
/// (file/recording_name.h). `default_preset` (a name, or empty) only adds its options for the scheme, and only to a URL
/// without format and preset.
tl::expected<transport::SinkEndpoint, std::string> parse_sink(std::string_view url,
                                                              std::string_view default_preset = {});

/// Parses a URL and opens it; throws TransportError, also for a wrong URL. `field_rate` as in SourceEndpoint::open.
std::unique_ptr<transport::Source> open_source(std::string_view url, double field_rate = 50.0);
/// Parses a URL and opens it; throws as open_source().
std::unique_ptr<transport::Sink> open_sink(std::string_view url);

}  // namespace trk_bridge::endpoints
