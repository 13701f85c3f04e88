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

/// `SCHEME:PLACE[?KEY=VALUE[&KEY=VALUE…]]`; place and values with their `%XX` still in them.
struct Url {
  std::string scheme;
  std::string place;
  std::vector<UrlOption> options;
};

/// The error says which part is wrong; a key twice is one, too.
tl::expected<Url, std::string> split_url(std::string_view url);

/// With every `%XX` replaced by its byte. The error names the text.
tl::expected<std::string, std::string> percent_decoded(std::string_view text);

/// `udp://HOST:PORT`, an IPv6 address in its brackets: how messages name the endpoint.
std::string udp_url(const std::string& host, std::uint16_t port);

}  // namespace trk_bridge::transport
