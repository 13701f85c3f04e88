// The parts of an endpoint's URL.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace trk_bridge::transport {

struct UrlOption {
  std::string key;
  std::string value;
};

/// `SCHEME:PLACE[?KEY=VALUE[&KEY=VALUE…]]`; the place with its `%XX` still in it, since its parts are split at characters
/// that they may stand for.
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

}  // namespace trk_bridge::transport
