#include "shortest.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

// With all of its powers as a table, 10 kB, it takes 8 ns rather than 14.
#define FMT_USE_FULL_CACHE_DRAGONBOX 1
#include <fmt/format.h>

#include "shape.h"

namespace trk_bridge::wire {

namespace {

constexpr std::array<std::uint64_t, 19> powers_of_ten() noexcept {
  std::array<std::uint64_t, 19> powers{};
  std::uint64_t power = 1;
  for (std::uint64_t& one : powers) {
    one = power;
    power *= 10;
  }
  return powers;
}
constexpr auto powers = powers_of_ten();

/// Of a number below 10^18.
int count_digits(std::uint64_t number) noexcept {
  // 1233 / 4096 is log10(2), near enough.
  const int bits = 64 - __builtin_clzll(number | 1U);
  const int digits = bits * 1233 / 4096;
  return digits + (number >= powers[static_cast<std::size_t>(digits)] ? 1 : 0);
}

/// The digits of a number below 10^8, leading zeros included, as characters: the first in the lowest byte.
inline std::uint64_t eight_digits(std::uint32_t number) noexcept {
  // Two numbers of four digits, then four of two, then eight of one, in lanes of one word. The factors are those of
  // 1 / 100 and 1 / 10, exact for what the lanes hold.
  std::uint64_t lanes = number / 10000 | std::uint64_t{number % 10000} << 32U;
  const std::uint64_t hundreds = (lanes * 10486 >> 20U) & 0x0000007F0000007FU;
  lanes = hundreds | (lanes - hundreds * 100) << 16U;
  const std::uint64_t tens = (lanes * 103 >> 10U) & 0x000F000F000F000FU;
  lanes = tens | (lanes - tens * 10) << 8U;
  return lanes | 0x3030303030303030U;
}

/// The digits of a number as characters. Zeros follow, so that there are `most_digits` of them, whatever number it is:
/// how many digits it has is not predictable, and a wrong guess takes as long as the rest.
struct Digits {
  static constexpr int most_digits = 17;

  char first;
  std::uint64_t next_eight, last_eight;

  Digits(std::uint64_t number, int count) noexcept {
    constexpr std::uint32_t block = 100'000'000;
    number *= powers[static_cast<std::size_t>(most_digits - count)];
    const auto upper = static_cast<std::uint32_t>(number / block);
    const auto lower = static_cast<std::uint32_t>(number - std::uint64_t{upper} * block);
    first = static_cast<char>('0' + upper / block);
    next_eight = eight_digits(upper % block);
    last_eight = eight_digits(lower);
  }

  void put(char* to) const noexcept {
    *to = first;
    store(next_eight, to + 1, ByteOrder::little);
    store(last_eight, to + 9, ByteOrder::little);
  }

  /// With a point behind the first `whole` of them, 1 to 17.
  void put(char* to, int whole) const noexcept {
    put(to + 1);
    const std::uint64_t eight = static_cast<unsigned char>(first) | next_eight << 8U;
    if (whole < 8) {
      const unsigned bits = 8 * static_cast<unsigned>(whole);
      const std::uint64_t before = (std::uint64_t{1} << bits) - 1;
      store((eight & before) | std::uint64_t{'.'} << bits | (eight << 8U & ~(before << 8U | 0xFFU)), to,
            ByteOrder::little);
      return;
    }
    std::memmove(to, to + 1, static_cast<std::size_t>(whole));
    to[whole] = '.';
  }
};

}  // namespace

char* write_shortest(double value, char* to) noexcept {
  if (std::signbit(value)) *to++ = '-';
  const double magnitude = std::abs(value);
  if (magnitude == 0) {
    *to++ = '0';
    return to;
  }
  const auto [digits, exponent] = fmt::detail::dragonbox::to_decimal(magnitude);
  const int count = count_digits(digits);
  // Without exponent where that is no longer, as to_chars does. The point that goes with one digit is one less.
  const int one_digit = count == 1 ? 1 : 0;
  const bool is_fixed = exponent >= -(count + 3) + one_digit && exponent <= 5 - one_digit;
  if (is_fixed && exponent > 0) {
    // Their digits are all shown, those too that reading back does not need.
    return std::to_chars(to, to + longest_number, magnitude).ptr;
  }
  const Digits text(digits, count);
  const int whole = count + exponent;
  if (is_fixed && whole > 0) {
    text.put(to, whole);
    return to + count + (whole < count ? 1 : 0);
  }
  if (is_fixed) {
    store(std::uint64_t{0x3030303030302E30U}, to, ByteOrder::little);
    to += 2 - whole;
    text.put(to);
    return to + count;
  }
  text.put(to, 1);
  to += count + (count > 1 ? 1 : 0);
  int power = whole - 1;
  *to++ = 'e';
  *to++ = power < 0 ? '-' : '+';
  power = std::abs(power);
  if (power < 10) *to++ = '0';
  return std::to_chars(to, to + 3, power).ptr;
}

}  // namespace trk_bridge::wire
