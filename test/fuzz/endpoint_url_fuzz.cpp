// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any text as an endpoint: its parts, printed and read again, and as a source and a sink of every scheme.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "endpoints/schemes.h"
#include "fuzz.h"
#include "transport/scheme.h"
#include "trk_bridge/endpoints/endpoints.h"

namespace {

using namespace trk_bridge;
using test::claim;
using transport::Direction;
using transport::Url;
using transport::UrlOption;

bool same_options(const std::vector<UrlOption>& a, const std::vector<UrlOption>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const UrlOption& x, const UrlOption& y) { return x.key == y.key && x.value == y.value; });
}

/// As a person may write it: all that could mean something else stands as %XX.
std::string printed(const Url& url) {
  std::string text = url.scheme + ":" + url.place;
  char mark = '?';
  for (const UrlOption& option : url.options) {
    text += mark + option.key + '=';
    mark = '&';
    for (const char c : option.value) {
      char escaped[4];
      std::snprintf(escaped, sizeof escaped, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
      // %00 is not allowed, and a NUL byte is as good as any other.
      text += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '\0' ? std::string(1, c) : escaped;
    }
  }
  return text;
}

void claim_reads_back(std::string_view text, const Url& url) {
  if (text.find(':') == std::string_view::npos) {
    claim(url.scheme.empty() && url.place == text && url.options.empty(), "a text without a colon in parts");
    return;
  }
  const auto again = transport::split_url(printed(url));
  claim(again && again->scheme == url.scheme && again->place == url.place && same_options(again->options, url.options),
        "not the same when printed and read again: " + printed(url));
}

/// Whether a lens table would be read from elsewhere than the folder of this run.
bool names_a_file(const Url& url) {
  return std::any_of(url.options.begin(), url.options.end(), [](const UrlOption& option) {
    return option.key == "lens" && option.value.find('/') != std::string::npos;
  });
}

template <typename Endpoint>
std::string error_of(const tl::expected<Endpoint, std::string>& endpoint, const std::string& text) {
  if (endpoint) {
    claim(endpoint->url == text && endpoint->open != nullptr, "an endpoint that cannot be opened");
    return {};
  }
  const std::string begin = "endpoint \"" + text + "\": ";
  claim(endpoint.error().size() > begin.size() && endpoint.error().compare(0, begin.size(), begin) == 0,
        "an error that does not say which endpoint");
  return endpoint.error().substr(begin.size());
}

/// Empty: it is accepted.
std::string verdict(const Url& url, Direction direction) {
  const std::string text = printed(url);
  return direction == Direction::read ? error_of(endpoints::parse_source(text), text)
                                      : error_of(endpoints::parse_sink(text), text);
}

bool names_option(const std::string& error, const std::vector<UrlOption>& options) {
  return std::any_of(options.begin(), options.end(),
                     [&](const UrlOption& option) { return error.find("option " + option.key) != std::string::npos; });
}

/// Options are accepted or the error names one of them, alone and all together; unknown ones are never accepted.
void claim_options(const Url& url, Direction direction) {
  const auto scheme = std::find_if(endpoints::schemes().begin(), endpoints::schemes().end(),
                                   [&](const auto* one) { return one->name == url.scheme; });
  if (scheme == endpoints::schemes().end()) {
    claim(!verdict(url, direction).empty(), "a scheme that nobody knows");
    return;
  }
  Url alone{url.scheme, url.place, {}};
  const bool place_is_valid = verdict(alone, direction).empty();
  auto known = (*scheme)->options(direction);
  if (direction == Direction::write) {
    known.insert(known.end(), transport::form_options.begin(), transport::form_options.end());
  }
  for (const UrlOption& option : url.options) {
    alone.options = {option};
    const std::string error = verdict(alone, direction);
    const bool is_known =
        std::any_of(known.begin(), known.end(), [&](const auto& one) { return one.key == option.key; });
    if (!is_known) claim(!error.empty(), "an unknown option that is accepted: " + option.key);
    if (place_is_valid && !error.empty()) claim(names_option(error, alone.options), "names no option: " + error);
  }
  const std::string error = verdict(url, direction);
  if (place_is_valid && !error.empty()) claim(names_option(error, url.options), "names no option of it: " + error);
}

/// The place of a source is a URL of the same place where its name has nothing that is written as %XX.
void claim_place(const Url& url) {
  const auto source = endpoints::parse_source(printed(url));
  if (!source) return;
  claim(!source->place.empty(), "a source without a place");
  if (source->place.find_first_of("%?[]") != std::string::npos) return;
  const auto again = endpoints::parse_source(source->place);
  claim(again && again->place == source->place, "another place when read again: " + source->place);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto url = transport::split_url(text);
  if (!url) {
    claim(!url.error().empty(), "an error without a word");
    error_of(endpoints::parse_source(text), text);
    error_of(endpoints::parse_sink(text), text);
    return 0;
  }
  claim_reads_back(text, *url);
  if (names_a_file(*url)) return 0;
  error_of(endpoints::parse_source(text), text);
  error_of(endpoints::parse_sink(text), text);
  if (url->scheme.empty()) return 0;
  claim_options(*url, Direction::read);
  claim_options(*url, Direction::write);
  claim_place(*url);
  return 0;
}
