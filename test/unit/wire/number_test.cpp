// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Numbers in text: as short as possible, exact, and the same in every locale.
#include <gmock/gmock.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <string>

#include "records.h"
#include "trk_bridge/wire/codec.h"
#include "wire/shortest.h"

namespace trk_bridge::wire::number_test {

/// A record with `word` as pan, field 5.
std::string with_pan(const std::string& word) { return "11 1 2 3 " + word + " 5 6 40 0 0 0 0 4 2 99"; }

tl::expected<double, Fault> read_pan(const std::string& word) {
  return params_from_text(with_pan(word)).map([](const CameraParams& p) { return p.euler.pan; });
}

std::string written_pan(double pan) {
  CameraParams p;
  p.format = euler;
  p.euler.pan = pan;
  Buffer buffer;
  const auto text = to_text(p, buffer);
  if (!text) return describe(text.error());
  std::istringstream words{std::string(*text)};
  std::string word;
  for (int i = 0; i < 5; ++i) words >> word;
  return word;
}

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// The shortest text with an exponent that gives the same number.
std::string shortest_scientific(double value) {
  char text[64];
  for (int digits = 0; digits < 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*e", digits, value);
    if (bits_of(std::strtod(text, nullptr)) == bits_of(value)) break;
  }
  return text;
}

TEST(Numbers, AnyDoubleReadsBackFromTheShortestText) {
  std::mt19937_64 random(2024);
  int tried = 0;
  while (tried < 100000) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    ++tried;
    const std::string word = written_pan(value);
    const auto read = read_pan(word);
    ASSERT_TRUE(read) << word;
    ASSERT_EQ(bits_of(*read), bits) << word;
    ASSERT_EQ(bits_of(std::strtod(word.c_str(), nullptr)), bits) << word;
    ASSERT_LE(word.size(), shortest_scientific(value).size()) << word;
  }
}

/// Numbers of the magnitudes in records, with up to 17 digits, some of them integers or 0.
double likely_number(std::mt19937_64& random) {
  const double value =
      std::uniform_real_distribution<double>(-200, 200)(random) * std::pow(10.0, static_cast<int>(random() % 24) - 12);
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", static_cast<int>(random() % 17) + 1, value);
  switch (random() % 8) {
    case 0:
      return std::trunc(value);
    case 1:
      return std::copysign(0.0, value);
    case 2:
      return value;
    default:
      return std::strtod(text, nullptr);
  }
}

TEST(Numbers, AreReadAsStrtodReadsThem) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 300000; ++i) {
    const double value = likely_number(random);
    // %g and %e like existing programs, more digits than a double has, and the exact value, which without its last
    // digit is often halfway between two others.
    const char* const format = std::array{"%.*g", "%.*e", "%.*f"}[static_cast<std::size_t>(random() % 3)];
    char word[400];
    std::snprintf(word, sizeof word, format, static_cast<int>(random() % 26), value);
    const auto read = read_pan(word);
    ASSERT_TRUE(read) << word;
    ASSERT_EQ(bits_of(*read), bits_of(std::strtod(word, nullptr))) << word;
  }
}

TEST(Numbers, HalfWayBetweenTwoDoubles) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 100000; ++i) {
    // An odd number of 54 bits, which no double can represent, and numbers just below and above it.
    const std::uint64_t half_way = (std::uint64_t{1} << 53U | random() >> 11U) | 1U;
    const std::uint64_t whole = half_way + random() % 3 - 1;
    for (const char* const behind : {"", ".", ".0", "e0", "e-5", "e5", "e-23"}) {
      const std::string word = std::to_string(whole) + behind;
      const auto read = read_pan(word);
      ASSERT_TRUE(read) << word;
      ASSERT_EQ(bits_of(*read), bits_of(std::strtod(word.c_str(), nullptr))) << word;
    }
  }
}

TEST(Numbers, AreWrittenAsToCharsWritesThem) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 500000; ++i) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value) || i % 4 != 0) value = likely_number(random);
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    char written[number_room];
    ASSERT_EQ(std::string(written, write_shortest(value, written)), std::string(text, end));
  }
}

/// Encoding with a memory must give the same result as without.
TEST(Numbers, RememberedTextsAreThoseOfTheSameNumbers) {
  std::mt19937_64 random(5);
  TextCache memory;
  CameraParams p;
  const auto change = [&random](double& number) {
    if (random() % 2 == 0) number = likely_number(random);
  };
  for (int i = 0; i < 20000; ++i) {
    p.format = random() % 4 == 0 ? std::uint32_t{0} : std::uint32_t{euler};
    p.id = static_cast<std::uint32_t>(random() % 3);
    for (double& number : p.matrix) change(number);
    for (double* const number : {&p.euler.x, &p.euler.y, &p.euler.pan, &p.fov, &p.k1, &p.focdist, &p.aperture}) {
      change(*number);
    }
    ++p.counter;
    Buffer buffer, expected;
    ASSERT_EQ(encode(p, {}, buffer, memory).value_or("refused"), encode(p, {}, expected).value()) << i;
  }
}

TEST(Numbers, SixDigitsAreNotEnough) { EXPECT_EQ(written_pan(179.99999), "179.99999"); }

TEST(Numbers, AreReadIfStrtodReadsThem) {
  for (const char* const word :
       {"0", "-0", "+1.5", "1.", ".5", "-.5e1", "+.5E+1", "007", "1e5", "1E-05", "179.99999", "6.199242e-02",
        "1.7976931348623157e308", "4.9e-324", "1e-310", "0e999999999999999999999", "0.000000000000000000000000001",
        "123456789012345678901234567890123456789012345678901234567890"}) {
    const auto read = read_pan(word);
    ASSERT_TRUE(read) << word << ": " << describe(read.error());
    EXPECT_EQ(bits_of(*read), bits_of(std::strtod(word, nullptr))) << word;
  }
}

TEST(Numbers, TooSmallIsZeroWithItsSign) {
  for (const std::string word :
       {"1e-400", "2e-324", "1e-99999999999999999999", "0.0000001e-320", "123456789e-999", "0.1e-323999"}) {
    ASSERT_TRUE(read_pan(word)) << word;
    EXPECT_EQ(bits_of(*read_pan(word)), bits_of(0.0)) << word;
    EXPECT_EQ(bits_of(*read_pan("-" + word)), bits_of(-0.0)) << word;
  }
  const std::string zeros(400, '0');
  EXPECT_EQ(read_pan("0." + zeros + "1"), 0.0);
}

struct Refused {
  const char* word;
  Reason reason;
};

TEST(Numbers, InvalidOnesAreRefusedWithAReason) {
  for (const auto& [word, reason] : {
           Refused{"1e999", Reason::out_of_range},
           Refused{"-1e309", Reason::out_of_range},
           Refused{"1e99999999999999999999", Reason::out_of_range},
           Refused{"0.00001e400", Reason::out_of_range},
           Refused{"nan", Reason::not_finite},
           Refused{"-NaN", Reason::not_finite},
           Refused{"nan(123)", Reason::not_finite},
           Refused{"inf", Reason::not_finite},
           Refused{"+INF", Reason::not_finite},
           Refused{"-Infinity", Reason::not_finite},
           Refused{"infinit", Reason::not_a_number},
           Refused{"1,5", Reason::not_a_number},
           Refused{"0x10", Reason::not_a_number},
           Refused{"0x1p3", Reason::not_a_number},
           Refused{"1e", Reason::not_a_number},
           Refused{"1e+", Reason::not_a_number},
           Refused{".", Reason::not_a_number},
           Refused{"-", Reason::not_a_number},
           Refused{"+", Reason::not_a_number},
           Refused{"+-1", Reason::not_a_number},
           Refused{"-+1", Reason::not_a_number},
           Refused{"--1", Reason::not_a_number},
           Refused{"1.2.3", Reason::not_a_number},
           Refused{"1d5", Reason::not_a_number},
           Refused{"12_000", Reason::not_a_number},
           Refused{"\xEF\xBC\x91", Reason::not_a_number},
       }) {
    const auto read = read_pan(word);
    ASSERT_FALSE(read) << word;
    EXPECT_EQ(read.error().reason, reason) << word;
    EXPECT_TRUE(read.error().about_field) << word;
    EXPECT_EQ(read.error().field, 5) << word;
  }
}

/// Writes and reads numbers that a locale with decimal commas would break.
void expect_points() {
  EXPECT_EQ(written_pan(1234567.25), "1234567.25");
  EXPECT_EQ(read_pan("1234567.25"), 1234567.25);
  EXPECT_FALSE(read_pan("1,5"));
  CameraConstants c;
  c.image_width = 12345;
  c.chip_width = 8.8;
  Buffer buffer;
  EXPECT_EQ(to_text(c, buffer), "12345 0 0 0 0 0 8.8 0 0 0");
  EXPECT_EQ(constants_from_text("12345 0 0 0 0 0 8.8 0 0 0"), c);
}

class CommaFacet : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Numbers, AreTheSameUnderACppLocaleWithCommas) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaFacet));
  std::ostringstream proof;
  proof << 1234.5;
  EXPECT_EQ(proof.str(), "1.234,5");
  expect_points();
  std::locale::global(before);
}

TEST(WholeNumbers, AreDecimal) {
  const auto c = constants_from_text("0720 +576 -3 -0 00 08 1 1 1 1");
  ASSERT_TRUE(c) << describe(c.error());
  EXPECT_EQ(c->image_width, 720);
  EXPECT_EQ(c->image_height, 576);
  EXPECT_EQ(c->blank_left, -3);
  EXPECT_EQ(c->blank_right, 0);
  EXPECT_EQ(c->blank_bottom, 8);
  const auto limits = constants_from_text("2147483647 -2147483648 0 0 0 0 1 1 1 1");
  ASSERT_TRUE(limits);
  EXPECT_EQ(limits->image_height, std::numeric_limits<std::int32_t>::min());
}

TEST(WholeNumbers, Refused) {
  for (const auto& [word, reason] :
       {Refused{"2147483648", Reason::out_of_range}, Refused{"-2147483649", Reason::out_of_range},
        Refused{"0x2D0", Reason::not_a_number}, Refused{"720.0", Reason::not_a_number},
        Refused{"7e2", Reason::not_a_number}, Refused{"+-1", Reason::not_a_number}, Refused{"+", Reason::not_a_number},
        Refused{"-", Reason::not_a_number}}) {
    const auto c = constants_from_text("720 576 " + std::string(word) + " 0 0 0 1 1 1 1");
    ASSERT_FALSE(c) << word;
    EXPECT_EQ(c.error().reason, reason) << word;
    EXPECT_EQ(c.error().field, 3) << word;
  }
}

struct Counter {
  const char* word;
  std::uint64_t value;
};

TEST(Counters, Are64BitsWide) {
  const std::string before = "1 1 2 3 4 5 6 40 0 0 0 0 4 2 ";
  for (const auto& [word, value] :
       {Counter{"18446744073709551615", 0xFFFFFFFFFFFFFFFF}, Counter{"+5", 5}, Counter{"0010", 10}, Counter{"-0", 0}}) {
    const auto p = params_from_text(before + word);
    ASSERT_TRUE(p) << word;
    EXPECT_EQ(p->counter, value);
  }
  for (const auto& [word, reason] :
       {Refused{"18446744073709551616", Reason::out_of_range}, Refused{"-1", Reason::out_of_range},
        Refused{"--1", Reason::not_a_number}, Refused{"1.0", Reason::not_a_number}}) {
    const auto p = params_from_text(before + word);
    ASSERT_FALSE(p) << word;
    EXPECT_EQ(p.error().reason, reason) << word;
    EXPECT_EQ(p.error().field, 15) << word;
  }
}

}  // namespace trk_bridge::wire::number_test
