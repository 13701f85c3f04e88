// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "scheme.h"

#include <algorithm>
#include <charconv>

namespace trk_bridge::transport {
namespace {

std::string joined(const std::vector<std::string_view>& keys) {
  std::string text;
  for (const auto key : keys) text += (text.empty() ? "" : ", ") + std::string(key);
  return text.empty() ? "none" : text;
}

}  // namespace

const char* word(Direction direction) noexcept { return direction == Direction::read ? "reading" : "writing"; }

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
  Url parts;
  if (colon == std::string_view::npos) {
    parts.place = url;
    return parts;
  }
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
    UrlOption pair{std::string(option.substr(0, equals)), {}};
    auto value = percent_decoded(option.substr(equals + 1));
    if (!value) return tl::make_unexpected("option " + pair.key + " = " + value.error());
    pair.value = *std::move(value);
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

std::string unknown_option(const std::string& key, std::string_view scheme, Direction direction,
                           const std::vector<std::string_view>& known, const std::vector<std::string_view>& other_way) {
  const auto in = [&key](const auto& keys) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  const auto form_keys = keys_of(form_options);
  auto all = known;
  if (direction == Direction::write) all.insert(all.end(), form_keys.begin(), form_keys.end());
  const std::string allowed =
      std::string(": the options for ") + word(direction) + " " + std::string(scheme) + " are " + joined(all);
  const bool is_for_other_way = in(other_way) || (direction == Direction::read && in(form_keys));
  if (!is_for_other_way) return "unknown option " + key + allowed;
  return "option " + key + " is for " + word(direction == Direction::read ? Direction::write : Direction::read) +
         allowed;
}

std::optional<double> real_number(std::string_view text, double lowest, double highest) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !(number >= lowest && number <= highest)) return {};
  return number;
}

bool assign_switch(const std::string& value, bool& to) {
  if (value != "0" && value != "1") return false;
  to = value == "1";
  return true;
}

bool assign_layout(const std::string& value, wire::LayoutChoice& to) {
  const auto choice = wire::layout_choice_from_word(value);
  if (choice) to = *choice;
  return choice.has_value();
}

SinkForm with_defaults(const SinkForm& given, const SinkForm& defaults) noexcept {
  SinkForm form = given.format ? given : defaults;
  form.id = given.id ? given.id : defaults.id;
  form.delay = given.delay ? given.delay : defaults.delay;
  form.lead = given.lead ? given.lead : defaults.lead;
  return form;
}

}  // namespace trk_bridge::transport
