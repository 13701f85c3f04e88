// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The interface of a scheme, and the parsing of URLs and options.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "trk_bridge/transport/endpoint.h"
#include "trk_bridge/wire/layout.h"

namespace trk_bridge::transport {

struct UrlOption {
  std::string key;
  std::string value;
};

/// `SCHEME:PLACE[?KEY=VALUE[&KEY=VALUE…]]`. `%XX` in the place is not decoded yet, because the place is first split at
/// characters that `%XX` may stand for.
struct Url {
  std::string scheme;
  std::string place;
  std::vector<UrlOption> options;
};

/// The error says which part is wrong; a key that is given twice is an error, too. A text without a colon has no
/// scheme.
tl::expected<Url, std::string> split_url(std::string_view url);

/// Replaces every `%XX` by its byte. The error names the text.
tl::expected<std::string, std::string> percent_decoded(std::string_view text);

/// `udp://HOST:PORT`, with an IPv6 address in brackets: the endpoint in messages.
std::string udp_url(const std::string& host, std::uint16_t port);

/// Reading and writing have different options.
enum class Direction : std::uint8_t { read, write };
/// "reading", "writing"
const char* word(Direction) noexcept;

struct Detection;

/// One option in the help for users.
struct OptionHelp {
  std::string_view key;
  std::string_view allowed;
  std::string_view help;  ///< what it does, and its default
};

/// A row of the table of schemes (endpoints/schemes.h); each scheme has its own folder. Errors name the part, its value
/// and what is allowed.
struct Scheme {
  std::string_view name;     ///< "udp"
  std::string_view usage;    ///< "udp://HOST:PORT"
  std::string_view summary;  ///< "trk in UDP datagrams"
  /// Without the options that every sink has.
  std::vector<OptionHelp> (*options)(Direction);
  /// The caller, endpoints, sets `url` and, for sinks, `form`.
  tl::expected<SourceEndpoint, std::string> (*source)(const Url&);
  tl::expected<SinkEndpoint, std::string> (*sink)(const Url&);
  const Detection* detection = nullptr;  ///< null if it is not a protocol over UDP
};

/// The options that every sink has. The module endpoints parses them, not the schemes.
inline constexpr std::array<OptionHelp, 5> form_options{{
    {"format", "words of the protocol separated by commas, as in euler,field_of_view", "Format of what is sent"},
    {"preset", "a name that trk presets lists", "Format of that receiver, instead of format"},
    {"id", "whole numbers from 0 to 4294967295", "Camera id to send instead of the received one"},
    {"delay", "0 to 1 seconds, or three such numbers separated by commas: for position, rotation and lens",
     "Send the camera as it was this long ago (0)"},
    {"lead", "0 to 0.04 seconds", "Extrapolate the camera at most this far beyond its newest sample (0)"},
}};

/// One option of a scheme in one direction. `set` returns false if the value is not `allowed`.
template <typename Settings>
struct Option {
  std::string_view key;
  std::string_view allowed;
  std::string_view help;  ///< see OptionHelp
  bool (*set)(const std::string& value, Settings& settings);
};

/// The error for an option that `scheme` does not have in this direction.
std::string unknown_option(const std::string& key, std::string_view scheme, Direction direction,
                           const std::vector<std::string_view>& known, const std::vector<std::string_view>& other_way);

/// The keys of option tables.
template <typename... Tables>
std::vector<std::string_view> keys_of(const Tables&... tables) {
  std::vector<std::string_view> keys;
  const auto add = [&keys](const auto& table) {
    for (const auto& option : table) keys.push_back(option.key);
  };
  (add(tables), ...);
  return keys;
}

/// The options of tables, in the help for users.
template <typename... Tables>
std::vector<OptionHelp> help_of(const Tables&... tables) {
  std::vector<OptionHelp> all;
  const auto add = [&all](const auto& table) {
    for (const auto& option : table) all.push_back({option.key, option.allowed, option.help});
  };
  (add(tables), ...);
  return all;
}

/// Sets every option of the URL in `settings`, by the given tables. `other_way` has the keys of the other direction,
/// for better errors.
template <typename Settings, typename... Tables>
tl::expected<void, std::string> set_options(const Url& url, Direction direction, Settings& settings,
                                            const std::vector<std::string_view>& other_way, const Tables&... tables) {
  for (const UrlOption& given : url.options) {
    std::string_view allowed;
    bool is_known = false;
    bool is_set = false;
    const auto look_in = [&](const auto& table) {
      for (const auto& option : table) {
        if (option.key != given.key) continue;
        is_known = true;
        allowed = option.allowed;
        is_set = option.set(given.value, settings);
      }
    };
    (look_in(tables), ...);
    if (!is_known) {
      return tl::make_unexpected(unknown_option(given.key, url.scheme, direction, keys_of(tables...), other_way));
    }
    if (!is_set) {
      return tl::make_unexpected("option " + given.key + " = \"" + given.value + "\": allowed are " +
                                 std::string(allowed));
    }
  }
  return {};
}

inline constexpr std::string_view switch_allowed = "0 and 1";
inline constexpr std::string_view layout_allowed =
    "auto, document and identified, the latter two also followed by _lp64, _llp64 or _i386 and that by _le or _be";

/// Parses all of `text` as a number within the range.
template <typename Number>
std::optional<Number> whole_number(std::string_view text, Number lowest, Number highest, int base = 10) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc{} || end != text.data() + text.size() || number < lowest || number > highest) return {};
  return number;
}
std::optional<double> real_number(std::string_view text, double lowest, double highest);

/// Assigns the value to `to` if there is one; returns whether there is.
template <typename T, typename U>
bool assign(const std::optional<T>& value, U& to) {
  if (value) to = *value;
  return value.has_value();
}
bool assign_switch(const std::string& value, bool& to);
bool assign_layout(const std::string& value, wire::LayoutChoice& to);

}  // namespace trk_bridge::transport
