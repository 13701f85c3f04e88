// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/endpoints/endpoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/nearest.h"
#include "file/scheme.h"
#include "freed/scheme.h"
#include "opentrackio/scheme.h"
#include "presets.h"
#include "schemes.h"
#include "shm/scheme.h"
#include "transport/scheme.h"
#include "trk/udp.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::endpoints {
namespace {

using transport::Delay;
using transport::Scheme;
using transport::SinkEndpoint;
using transport::SinkForm;
using transport::SourceEndpoint;
using transport::TransportError;
using transport::Url;

constexpr std::array<const Scheme*, 5> all_schemes{&trk::udp_scheme, &freed::scheme, &opentrackio::scheme, &shm::scheme,
                                                   &file::scheme};

struct Parsed {
  Url url;
  const Scheme* scheme;
};

/// The URL that a text without a known scheme was probably meant to be; empty: none is similar.
std::string suggestion_for(const std::string& text, const Url& url) {
  if (transport::whole_number(text, 0, 61)) return "shm:" + text;
  if (transport::whole_number(text, 1, 65535)) return "udp://:" + text;
  // A host and a port, the port alone, or an IPv6 address in brackets.
  const bool has_port = transport::whole_number(url.place, 1, 65535).has_value();
  if (text.front() == '[' || (has_port && text.find('/') == std::string::npos)) return "udp://" + text;
  const std::string before = text.substr(0, text.find(':'));
  if (before.find('/') != std::string::npos || (url.scheme.empty() && text.find('.') != std::string::npos)) {
    return "file:" + text;
  }
  std::vector<std::string> names;
  for (const Scheme* scheme : all_schemes) names.emplace_back(scheme->name);
  const auto name = base::likely(url.scheme, names);
  return name ? *name + text.substr(url.scheme.size()) : "";
}

tl::expected<Parsed, std::string> parsed(std::string_view text) {
  auto url = transport::split_url(text);
  if (!url) return tl::make_unexpected(url.error());
  const auto scheme =
      std::find_if(all_schemes.begin(), all_schemes.end(), [&](const Scheme* s) { return s->name == url->scheme; });
  if (scheme == all_schemes.end()) {
    std::string error = url->scheme.empty() ? std::string("no scheme") : "unknown scheme \"" + url->scheme + "\"";
    const std::string suggestion = text.empty() ? "" : suggestion_for(std::string(text), *url);
    if (!suggestion.empty()) error += ", did you mean " + suggestion + "?";
    return tl::make_unexpected(error + (suggestion.empty() ? ": allowed are " : " Allowed are ") + usages());
  }
  return Parsed{*std::move(url), *scheme};
}

tl::expected<std::uint32_t, std::string> format_from(std::string words) {
  // URLs have no spaces.
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == ',' || c == '+'; }, ' ');
  const auto format = wire::format_from_words(words);
  if (!format) return tl::make_unexpected(format.error());
  return *format;
}

/// Parses seconds; returns ns.
std::optional<std::int64_t> nanoseconds_from(std::string_view seconds, std::int64_t most) {
  const auto number = transport::real_number(seconds, 0, static_cast<double>(most) / 1e9);
  if (!number) return std::nullopt;
  return std::llround(*number * 1e9);
}

/// Parses one number, or three separated by commas.
std::optional<Delay> delay_from(std::string_view text) {
  std::vector<std::int64_t> parts;
  for (bool more = true; more;) {
    const auto comma = text.find(',');
    const auto part = nanoseconds_from(text.substr(0, comma), Delay::most);
    if (!part) return std::nullopt;
    parts.push_back(*part);
    more = comma != std::string_view::npos;
    if (more) text.remove_prefix(comma + 1);
  }
  if (parts.size() == 1) return Delay{parts[0], parts[0], parts[0]};
  if (parts.size() == 3) return Delay{parts[0], parts[1], parts[2]};
  return std::nullopt;
}

/// Adds the options of the preset that the URL does not have. The error is that the preset is for another scheme.
tl::expected<void, std::string> apply_preset(const Preset& preset, Url& url) {
  if (preset.scheme.empty()) return {};
  if (preset.scheme != url.scheme) {
    return tl::make_unexpected("the preset " + preset.name + " is for " + preset.scheme + ", and not for " +
                               url.scheme);
  }
  for (const auto& option : preset.options) {
    const bool is_given =
        std::any_of(url.options.begin(), url.options.end(), [&](const auto& given) { return given.key == option.key; });
    if (!is_given) url.options.push_back(option);
  }
  return {};
}

/// The error for an invalid value of an option that every sink has.
tl::unexpected<std::string> not_allowed(std::string_view key, const std::string& value) {
  const auto option = std::find_if(transport::form_options.begin(), transport::form_options.end(),
                                   [key](const auto& known) { return known.key == key; });
  return tl::make_unexpected("option " + std::string(key) + " = \"" + value + "\": allowed are " +
                             std::string(option->allowed));
}

/// Removes the options that every sink has from the URL.
tl::expected<SinkForm, std::string> extract_form(Url& url) {
  const auto extract = [&url](std::string_view key) -> std::optional<std::string> {
    const auto option =
        std::find_if(url.options.begin(), url.options.end(), [&](const auto& o) { return o.key == key; });
    if (option == url.options.end()) return std::nullopt;
    std::string value = std::move(option->value);
    url.options.erase(option);
    return value;
  };
  const auto words = extract("format"), preset_name = extract("preset"), id = extract("id");
  const auto delay = extract("delay"), lead = extract("lead");
  SinkForm form;
  if (words && preset_name) {
    return tl::make_unexpected("option preset = \"" + *preset_name + "\": must not be given together with format");
  }
  if (words) {
    const auto format = format_from(*words);
    if (!format) return tl::make_unexpected("option format = \"" + *words + "\": " + format.error());
    form.format = *format;
  }
  if (preset_name) {
    const auto preset = find_preset(*preset_name);
    if (!preset) return tl::make_unexpected("option preset: " + preset.error());
    form.format = preset->format;
    form.sends_id = preset->sends_id;
    if (const auto applied = apply_preset(*preset, url); !applied) return tl::make_unexpected(applied.error());
  }
  if (id) {
    constexpr std::uint32_t largest = std::numeric_limits<std::uint32_t>::max();
    form.id = transport::whole_number<std::uint32_t>(*id, 0, largest);
    if (!form.id) return not_allowed("id", *id);
    if (!form.sends_id && *form.id != 0) {
      return tl::make_unexpected("option id = \"" + *id + "\": the preset " + *preset_name +
                                 " sends no id; only 0 is allowed");
    }
  }
  if (delay && !(form.delay = delay_from(*delay))) return not_allowed("delay", *delay);
  if (lead && !(form.lead = nanoseconds_from(*lead, transport::most_lead))) return not_allowed("lead", *lead);
  return form;
}

template <typename Endpoint>
tl::expected<Endpoint, std::string> with_url(std::string_view url, tl::expected<Endpoint, std::string> endpoint) {
  if (!endpoint) return tl::make_unexpected("endpoint \"" + std::string(url) + "\": " + endpoint.error());
  endpoint->url = url;
  return endpoint;
}

tl::expected<SinkEndpoint, std::string> sink_endpoint(std::string_view text, std::string_view default_preset) {
  auto url = parsed(text);
  if (!url) return tl::make_unexpected(url.error());
  const auto& options = url->url.options;
  const bool has_format = std::any_of(options.begin(), options.end(), [](const auto& option) {
    return option.key == "format" || option.key == "preset";
  });
  if (!has_format && !default_preset.empty()) {
    const auto preset = find_preset(default_preset);
    if (!preset) return tl::make_unexpected(preset.error());
    if (const auto applied = apply_preset(*preset, url->url); !applied) return tl::make_unexpected(applied.error());
  }
  const auto form = extract_form(url->url);
  if (!form) return tl::make_unexpected(form.error());
  auto endpoint = url->scheme->sink(url->url);
  if (endpoint) endpoint->form = *form;
  return endpoint;
}

tl::expected<SourceEndpoint, std::string> source_endpoint(std::string_view text) {
  const auto url = parsed(text);
  if (!url) return tl::make_unexpected(url.error());
  return url->scheme->source(url->url);
}

}  // namespace

const std::array<const Scheme*, 5>& schemes() { return all_schemes; }

std::string prefix_of(const Scheme& scheme) {
  const bool has_host = scheme.usage.find("://") != std::string_view::npos;
  return std::string(scheme.name) + (has_host ? "://" : ":");
}

std::string usages() {
  std::string text;
  for (std::size_t i = 0; i < all_schemes.size(); ++i) {
    text += i == 0 ? "" : i + 1 == all_schemes.size() ? " and " : ", ";
    text += all_schemes[i]->usage;
  }
  return text;
}

tl::expected<SourceEndpoint, std::string> parse_source(std::string_view url) {
  return with_url(url, source_endpoint(url));
}

tl::expected<SinkEndpoint, std::string> parse_sink(std::string_view url, std::string_view default_preset) {
  return with_url(url, sink_endpoint(url, default_preset));
}

std::unique_ptr<transport::Source> open_source(std::string_view url, double field_rate) {
  const auto endpoint = parse_source(url);
  if (!endpoint) throw TransportError(endpoint.error());
  return endpoint->open(field_rate);
}

std::unique_ptr<transport::Sink> open_sink(std::string_view url) {
  const auto endpoint = parse_sink(url);
  if (!endpoint) throw TransportError(endpoint.error());
  auto sink = endpoint->open();
  sink->prepare();
  return sink;
}

}  // namespace trk_bridge::endpoints
