// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What fuzz targets have in common: claims, and numbers from the bytes of an input.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace trk_bridge::test {

/// Ends the program, which the fuzzer and the replay take for a finding, unless `broken` is empty.
inline void claim(const std::string& broken) {
  if (broken.empty()) return;
  std::fprintf(stderr, "broken: %s\n", broken.c_str());
  std::abort();
}
inline void claim(bool holds, const std::string& what) {
  if (!holds) claim(what);
}

/// The bytes of an input from its beginning to its end; behind it, zeros.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : rest_(reinterpret_cast<const char*>(data), size) {}

  bool is_empty() const noexcept { return rest_.empty(); }
  /// All that is left.
  std::string_view rest() const noexcept { return rest_; }
  /// At most `size` bytes.
  std::string_view bytes(std::size_t size) noexcept {
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  template <typename Number>
  Number number() noexcept {
    Number number{};
    const std::string_view taken = bytes(sizeof number);
    if (!taken.empty()) std::memcpy(&number, taken.data(), taken.size());
    return number;
  }
  /// 0 to `limit` - 1, from one byte.
  std::size_t below(std::size_t limit) noexcept { return number<std::uint8_t>() % limit; }
  bool flag() noexcept { return below(2) == 1; }

 private:
  std::string_view rest_;
};

}  // namespace trk_bridge::test
