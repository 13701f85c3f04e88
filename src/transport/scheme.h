// One row of the table of schemes, and how a scheme reads its URLs.
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

/// `SCHEME:PLACE[?KEY=VALUE[&KEY=VALUE…]]`; the place with its `%XX` still in it, since its parts are split at
/// characters that they may stand for.
struct Url {
  std::string scheme;
  std::string place;
  std::vector<UrlOption> options;
};

/// The error says which part is wrong; a key twice is one, too. A text without a colon has no scheme.
tl::expected<Url, std::string> split_url(std::string_view url);

/// With every `%XX` replaced by its byte. The error names the text.
tl::expected<std::string, std::string> percent_decoded(std::string_view text);

/// `udp://HOST:PORT`, an IPv6 address in its brackets: how messages name the endpoint.
std::string udp_url(const std::string& host, std::uint16_t port);

/// Which way the bytes go: options differ.
enum class Direction : std::uint8_t { read, write };
/// "reading", "writing"
const char* word(Direction) noexcept;

struct Detection;

/// One option as people read it.
struct OptionHelp {
  std::string_view key;
  std::string_view allowed;
  std::string_view help;  ///< what it does, and its default
};

/// What a folder of its own gives to the table (endpoints/schemes.h). Errors name the part, its value and what is
/// allowed.
struct Scheme {
  std::string_view name;     ///< "udp"
  std::string_view usage;    ///< "udp://HOST:PORT"
  std::string_view summary;  ///< "trk in UDP datagrams"
  /// Without those of every sink.
  std::vector<OptionHelp> (*options)(Direction);
  /// `url` and, for sinks, `form` are the table's to fill in.
  tl::expected<SourceEndpoint, std::string> (*source)(const Url&);
  tl::expected<SinkEndpoint, std::string> (*sink)(const Url&);
  const Detection* detection = nullptr;  ///< null: not a protocol over UDP
};

/// The options of every sink, whatever its scheme: they are read by the table, not by schemes.
inline constexpr std::array<OptionHelp, 5> form_options{{
    {"format", "words of the protocol with commas between, as in euler,field_of_view", "Format of what is sent"},
    {"preset", "a name that trk presets lists", "Format of that receiver, in place of format"},
    {"id", "whole numbers from 0 to 4294967295", "Camera number in place of the one that came"},
    {"delay", "0 to 1 seconds, or three such numbers with commas between: of position, rotation and lens",
     "Send the camera as it was this long ago (0)"},
    {"lead", "0 to 0.04 seconds", "Extrapolate the camera at most so far beyond its newest sample (0)"},
}};

/// One option of a scheme in one direction. `set` is false when the value is not one of the `allowed`.
template <typename Settings>
struct Option {
  std::string_view key;
  std::string_view allowed;
  std::string_view help;  ///< see OptionHelp
  bool (*set)(const std::string& value, Settings& settings);
};

/// The error of an option that `scheme` does not know in this direction.
std::string unknown_option(const std::string& key, std::string_view scheme, Direction direction,
                           const std::vector<std::string_view>& known, const std::vector<std::string_view>& other_way);

/// The keys of tables of options.
template <typename... Tables>
std::vector<std::string_view> keys_of(const Tables&... tables) {
  std::vector<std::string_view> keys;
  const auto add = [&keys](const auto& table) {
    for (const auto& option : table) keys.push_back(option.key);
  };
  (add(tables), ...);
  return keys;
}

/// The options of tables as people read them.
template <typename... Tables>
std::vector<OptionHelp> help_of(const Tables&... tables) {
  std::vector<OptionHelp> all;
  const auto add = [&all](const auto& table) {
    for (const auto& option : table) all.push_back({option.key, option.allowed, option.help});
  };
  (add(tables), ...);
  return all;
}

/// Sets every option of the URL in `settings`, which each of the tables is for. `other_way` are the keys of the other
/// direction, for better errors.
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

/// All of `text` as a number within the range.
template <typename Number>
std::optional<Number> whole_number(std::string_view text, Number lowest, Number highest, int base = 10) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc{} || end != text.data() + text.size() || number < lowest || number > highest) return {};
  return number;
}
std::optional<double> real_number(std::string_view text, double lowest, double highest);

/// Whether there is a value, which `to` then has.
template <typename T, typename U>
bool assign(const std::optional<T>& value, U& to) {
  if (value) to = *value;
  return value.has_value();
}
bool assign_switch(const std::string& value, bool& to);
bool assign_layout(const std::string& value, wire::LayoutChoice& to);

}  // namespace trk_bridge::transport
