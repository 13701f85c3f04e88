#include "url.h"

#include <algorithm>
#include <charconv>

namespace trk_bridge::transport {

tl::expected<std::string, std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const std::string_view digits = text.substr(i + 1, 2);
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (digits.size() != 2 || error != std::errc{} || end != digits.data() + 2 || byte == 0) {
      return tl::make_unexpected("\"" + std::string(text) + "\": after % two hexadecimal digits other than 00 are " +
                                 "allowed (a % itself is %25)");
    }
    decoded += static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

tl::expected<Url, std::string> split_url(std::string_view url) {
  const std::size_t colon = url.find(':');
  if (colon == std::string_view::npos) {
    return tl::make_unexpected(std::string("no scheme: udp://HOST:PORT, shm:SLOT and file:PATH are allowed"));
  }
  Url parts;
  parts.scheme = url.substr(0, colon);
  const std::string_view rest = url.substr(colon + 1);
  const std::size_t question = rest.find('?');
  parts.place = rest.substr(0, question);
  if (question == std::string_view::npos) return parts;

  std::string_view options = rest.substr(question + 1);
  for (bool more = !options.empty(); more;) {
    const std::size_t ampersand = options.find('&');
    const std::string_view option = options.substr(0, ampersand);
    more = ampersand != std::string_view::npos;
    if (more) options.remove_prefix(ampersand + 1);

    const std::size_t equals = option.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      return tl::make_unexpected("option \"" + std::string(option) + "\": KEY=VALUE is allowed");
    }
    UrlOption pair{std::string(option.substr(0, equals)), std::string(option.substr(equals + 1))};
    const bool twice = std::any_of(parts.options.begin(), parts.options.end(),
                                   [&pair](const UrlOption& other) { return other.key == pair.key; });
    if (twice) return tl::make_unexpected("option " + pair.key + " is given twice");
    parts.options.push_back(std::move(pair));
  }
  return parts;
}

std::string udp_url(const std::string& host, std::uint16_t port) {
  const bool ipv6 = host.find(':') != std::string::npos;
  return "udp://" + (ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

}  // namespace trk_bridge::transport
