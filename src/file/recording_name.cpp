// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "recording_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <climits>
#include <cstdio>
#include <ctime>
#include <optional>

#include <glob.h>

#include "transport/scheme.h"

namespace trk_bridge::file {
namespace {

constexpr int highest_number = 9999;

/// A conversion and its number of digits.
struct Conversion {
  char letter;
  int digits;
};
constexpr std::array<Conversion, 8> conversions{
    {{'Y', 4}, {'y', 2}, {'m', 2}, {'d', 2}, {'j', 3}, {'H', 2}, {'M', 2}, {'S', 2}}};

const Conversion* conversion_of(char letter) {
  const auto* found = std::find_if(conversions.begin(), conversions.end(),
                                   [letter](const Conversion& one) { return one.letter == letter; });
  return found == conversions.end() ? nullptr : found;
}

/// Escapes the special characters of glob.
std::string escaped(std::string_view text) {
  std::string pattern;
  for (const char c : text) {
    if (c == '*' || c == '?' || c == '[' || c == ']' || c == '\\') pattern += '\\';
    pattern += c;
  }
  return pattern;
}

std::string digits_pattern(int count) {
  std::string pattern;
  for (int i = 0; i < count; ++i) pattern += "[0-9]";
  return pattern;
}

std::vector<std::string> files_like(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> names;
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  return names;
}

std::string numbered(const std::string& path, int number) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "-%03d", number);
  const std::size_t ending = ending_of(path);
  return path.substr(0, ending) + text.data() + path.substr(ending);
}

int highest_number_of(const std::string& path) {
  const std::string before = path.substr(0, ending_of(path)) + "-";
  int highest = 0;
  for (const auto& name : files_like(escaped(before) + digits_pattern(3) + "*")) {
    int number = 0;
    const auto [end, error] = std::from_chars(name.data() + before.size(), name.data() + name.size(), number);
    const bool is_whole = end == name.data() + name.size() || *end == '.';
    if (error == std::errc{} && is_whole && number <= highest_number) highest = std::max(highest, number);
  }
  return highest;
}

}  // namespace

tl::expected<RecordingName, std::string> RecordingName::parse(std::string_view text) {
  RecordingName name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      name.format_ += text[i];
    } else if (i + 1 < text.size() && conversion_of(text[i + 1]) != nullptr) {
      name.format_ += text.substr(i++, 2);
      name.has_time_ = true;
    } else {
      const auto byte = transport::percent_decoded(text.substr(i, 3));
      if (!byte) {
        return tl::unexpected("\"" + std::string(text) +
                              "\": after %, allowed are Y y m d j H M S for the time of the " +
                              "first field, and two hexadecimal digits other than 00 for a byte (a % itself is %25)");
      }
      name.format_ += *byte == "%" ? "%%" : *byte;
      i += 2;
    }
  }
  return name;
}

std::string RecordingName::at(std::int64_t time) const {
  constexpr std::int64_t second = 1'000'000'000;
  const auto seconds = static_cast<std::time_t>(time / second);
  std::tm parts{};
  std::array<char, PATH_MAX> text{};
  ::gmtime_r(&seconds, &parts);
  return {text.data(), std::strftime(text.data(), text.size(), format_.c_str(), &parts)};
}

std::string RecordingName::shown() const {
  std::string text;
  for (std::size_t i = 0; i < format_.size(); ++i) {
    text += format_[i];
    if (format_[i] == '%' && format_[i + 1] == '%') ++i;
  }
  return text;
}

std::string RecordingName::pattern() const {
  std::string pattern;
  for (std::size_t i = 0; i < format_.size(); ++i) {
    if (format_[i] != '%') {
      pattern += escaped(std::string_view(format_).substr(i, 1));
      continue;
    }
    const auto* conversion = conversion_of(format_[++i]);
    pattern += conversion == nullptr ? "%" : digits_pattern(conversion->digits);
  }
  return pattern;
}

OpenedFile open_next_number(const std::string& path) {
  PartFile::Options options;
  options.part = Part::refused;
  for (int number = highest_number_of(path) + 1; number <= highest_number; ++number) {
    auto file = PartFile::open(numbered(path, number), options);
    if (file) return file;
    const auto reason = file.error().reason;
    if (reason != transport::SinkReason::exists && reason != transport::SinkReason::in_use) return file;
  }
  return transport::refused(transport::SinkReason::no_free_number);
}

std::vector<std::string> recover_parts(const RecordingName& name, bool has_number) {
  const std::string pattern = name.pattern();
  const std::size_t ending = ending_of(pattern);
  std::vector<std::string> parts;
  if (!has_number) parts = files_like(pattern + ".part");
  for (const int digits : {3, 4}) {
    if (!has_number) break;
    const auto found =
        files_like(pattern.substr(0, ending) + "-" + digits_pattern(digits) + pattern.substr(ending) + ".part");
    parts.insert(parts.end(), found.begin(), found.end());
  }
  std::vector<std::string> recovered;
  for (const auto& part : parts) {
    if (auto published = recover_part(part)) recovered.push_back(*std::move(published));
  }
  return recovered;
}

}  // namespace trk_bridge::file
