// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// All reasons for which bytes cannot be decoded, or a record cannot be encoded.
#include "trk_bridge/wire/fault.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "records.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire::fault_test {

using test::encoded;
using test::RandomRecords;

using namespace std::string_literals;

constexpr int no_field = -1;
constexpr int matrix_places[16] = {2, 3, 4, 4, 5, 6, 7, 7, 8, 9, 10, 10, 11, 12, 13, 13};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// "reason" or "reason at field", for simple comparisons.
std::string brief(const Fault& fault) {
  return std::string(name(fault.reason)) + (fault.about_field ? " at " + std::to_string(fault.field) : "");
}

template <class Result>
std::string fault_of(const Result& result) {
  return result ? "no fault" : brief(result.error());
}

std::string decode_fault(const std::string& datagram, const LayoutChoice& given = {}) {
  LayoutDetector detector(given);
  return fault_of(decode(datagram, detector));
}

const std::string good_euler = "11 1 2 3 4 5 6 40 0 0 0 0 4 2 99";
const std::string good_matrix = "12 1 0 0 0 1 0 0 0 1 5 6 7 40 0 0 0 0 4 2 99";
const std::string good_constants = "720 576 1 2 3 4 8.8 6.6 8.9 6.7";

std::string params(const std::string& text) { return "DMC01\0PA"s + text; }
std::string constants(const std::string& text) { return "DMC01\0CA"s + text; }

/// `text` with its `index`-th word replaced.
std::string with_word(const std::string& text, std::size_t index, const std::string& word) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < index; ++i) begin = text.find(' ', begin) + 1;
  const std::size_t end = std::min(text.find(' ', begin), text.size());
  return text.substr(0, begin) + word + text.substr(end);
}

std::size_t words_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), ' ')) + 1;
}

TEST(Faults, OfTheHeader) {
  EXPECT_EQ(decode_fault(""), "truncated");
  EXPECT_EQ(decode_fault("DMC"), "truncated");
  EXPECT_EQ(decode_fault("DMC01\0"s), "truncated");
  EXPECT_EQ(decode_fault("DMC01\0P"s), "truncated");
  EXPECT_EQ(decode_fault("DMC01\0X"s), "bad type");
  EXPECT_EQ(decode_fault("X"), "bad magic");
  EXPECT_EQ(decode_fault("DMC02\0PA"s + good_euler), "bad magic");
  EXPECT_EQ(decode_fault("DMC01 PA" + good_euler), "bad magic");
  EXPECT_EQ(decode_fault("dmc01\0PA"s + good_euler), "bad magic");
  EXPECT_EQ(decode_fault("DMC01\0pA"s + good_euler), "bad type");
  EXPECT_EQ(decode_fault("DMC01\0PX"s + good_euler), "bad encoding");
  EXPECT_EQ(decode_fault("DMC01\0PA"s), "truncated at 1");
  EXPECT_EQ(decode_fault("DMC01\0CA\0"s), "truncated at 1");
}

TEST(Faults, OfTheLength) {
  const std::string longest = params(good_euler) + std::string(max_datagram - params(good_euler).size(), ' ');
  EXPECT_EQ(decode_fault(longest), "no fault");
  EXPECT_EQ(decode_fault(longest + ' '), "too long");
}

TEST(Faults, EveryFieldOfTextIsNamed) {
  for (const auto& [text, is_params] : {std::pair(good_euler, true), {good_matrix, true}, {good_constants, false}}) {
    const auto datagram = [is = is_params](const std::string& t) { return is ? params(t) : constants(t); };
    ASSERT_EQ(decode_fault(datagram(text)), "no fault");
    for (std::size_t i = 0; i < words_in(text); ++i) {
      const std::string field = std::to_string(i + 1);
      EXPECT_EQ(decode_fault(datagram(with_word(text, i, "zero"))), "not a number at " + field);
      const bool whole = is_params ? i + 1 == words_in(text) : i < 6;
      const std::string too_large = i == 0 && is_params ? "100000000" : whole ? "18446744073709551616" : "1e309";
      EXPECT_EQ(decode_fault(datagram(with_word(text, i, too_large))), "out of range at " + field);
      const std::string before = with_word(text, i, "\0"s);
      EXPECT_EQ(decode_fault(datagram(before.substr(0, before.find('\0')))), "truncated at " + field);
    }
    EXPECT_EQ(decode_fault(datagram(text + " 1")), "trailing text");
    EXPECT_EQ(decode_fault(datagram(text + " #")), "trailing text");
  }
}

TEST(Faults, OfTheFormatWord) {
  EXPECT_EQ(decode_fault(params(with_word(good_euler, 0, "100000001"))), "out of range at 1");
  EXPECT_EQ(decode_fault(params(with_word(good_euler, 0, "0x"))), "not a number at 1");
  EXPECT_EQ(decode_fault(params(with_word(good_euler, 0, "-11"))), "not a number at 1");
  EXPECT_EQ(decode_fault(params(with_word(good_euler, 0, "+11"))), "not a number at 1");
  for (const char* const word : {"0x2af", "0X2AF", "2aF", "0000000002AF"}) {
    const auto p = params_from_text(with_word(good_euler, 0, word));
    ASSERT_TRUE(p) << word;
    EXPECT_EQ(p->format, 0x2AFU);
  }
  const auto unknown = params_from_text(with_word(good_euler, 0, "FFFFFC01"));
  ASSERT_TRUE(unknown);
  EXPECT_EQ(unknown->format, 0xFFFFFC01U);
}

TEST(Faults, OfTheId) {
  EXPECT_EQ(decode_fault(params("I " + good_euler)), "not a number at 0");
  EXPECT_EQ(decode_fault(params("I-1 " + good_euler)), "not a number at 0");
  EXPECT_EQ(decode_fault(params("I1.0 " + good_euler)), "not a number at 0");
  EXPECT_EQ(decode_fault(params("I4294967296 " + good_euler)), "out of range at 0");
  EXPECT_EQ(decode_fault(params("i1 " + good_euler)), "not a number at 1");
  EXPECT_EQ(decode_fault(params("I1 I1 " + good_euler)), "not a number at 1");
  EXPECT_EQ(decode_fault(params(good_euler + " I1")), "trailing text");
  EXPECT_EQ(decode_fault(params("I1")), "truncated at 1");
  EXPECT_EQ(params_from_text(" I007\t" + good_euler)->id, 7U);
  EXPECT_EQ(constants_from_text("I4294967295 " + good_constants)->id, 4294967295U);
}

TEST(Faults, OnlyBlanksMayFollowTheNul) {
  EXPECT_EQ(decode_fault(params(good_euler + "\0"s)), "no fault");
  EXPECT_EQ(decode_fault(params(good_euler + " \r\n\v\f\t\0\0 \0\n"s)), "no fault");
  EXPECT_EQ(decode_fault(params(good_euler + "\0x"s)), "trailing text");
  EXPECT_EQ(decode_fault(params("11 1 2 3\0 4 5 6 40 0 0 0 0 4 2 99"s)), "trailing text");
}

TEST(Faults, OfBinarySizes) {
  const std::string header = "DMC01\0PB"s;
  RandomRecords random(5);
  const CameraParams p = random.params(euler);
  for (std::size_t size = 0; size < max_datagram - header_size; ++size) {
    if (size == 192 || size == 196 || size == 200) continue;
    ASSERT_EQ(decode_fault(header + std::string(size, '\0')), "wrong size") << size;
  }
  for (std::size_t size = 0; size < 200; ++size) {
    if (size == 56 || size == 60 || size == 64) continue;
    ASSERT_EQ(decode_fault("DMC01\0CB"s + std::string(size, '\0')), "wrong size") << size;
  }
  const std::string lp64 = encoded(p, {Encoding::binary, {Generation::identified, Abi::lp64, ByteOrder::little}});
  EXPECT_EQ(decode_fault(lp64, {{}, Abi::i386, {}}), "layout mismatch");
  EXPECT_EQ(decode_fault(lp64, {Generation::identified, Abi::lp64, {}}), "no fault");
  EXPECT_EQ(decode_fault(lp64.substr(0, 200 - 4 + 8), {{}, Abi::lp64, {}}), "layout mismatch");
  EXPECT_EQ(decode_fault(lp64.substr(0, 200 - 4 + 8), {Generation::document, {}, {}}), "layout mismatch");
  const std::string c =
      encoded(random.constants(), {Encoding::binary, {Generation::document, Abi::lp64, ByteOrder::little}});
  EXPECT_EQ(decode_fault(c, {Generation::identified, {}, {}}), "layout mismatch");
}

TEST(Faults, AnImageOfAnotherSizeIsRefused) {
  const Layout layout{Generation::identified, Abi::i386, ByteOrder::little};
  EXPECT_EQ(fault_of(params_from_image(std::string(200, '\0'), layout)), "wrong size");
  EXPECT_EQ(fault_of(params_from_image("", layout)), "wrong size");
  EXPECT_EQ(fault_of(constants_from_image(std::string(64, '\0'), layout)), "wrong size");
}

/// Writes `record` in both encodings, after its `number` is made not finite.
void expect_not_written(const CameraParams& record, double& number, int field, bool in_text = true) {
  const double before = number;
  Buffer buffer;
  const std::string expected = "not finite at " + std::to_string(field);
  for (const double bad : {nan, infinity, -infinity}) {
    number = bad;
    EXPECT_EQ(fault_of(encode(record, {Encoding::binary, {}}, buffer)), expected);
    EXPECT_EQ(fault_of(encode(record, {Encoding::ascii, {}}, buffer)), in_text ? expected : "no fault");
  }
  number = before;
}

TEST(Faults, NumbersThatAreNotFiniteAreNotWritten) {
  RandomRecords random(3);
  CameraParams p = random.params(euler | field_of_view);
  int field = 2;
  for (double* const number : {&p.euler.x, &p.euler.y, &p.euler.z, &p.euler.pan, &p.euler.tilt, &p.euler.roll, &p.fov,
                               &p.center_x, &p.center_y, &p.k1, &p.k2, &p.focdist, &p.aperture}) {
    expect_not_written(p, *number, field++);
  }
  CameraParams m = random.params(field_of_view);
  for (std::size_t i = 0; i < 16; ++i) expect_not_written(m, m.matrix[i], matrix_places[i], i % 4 != 3);
  field = 14;
  for (double* const number : {&m.fov, &m.center_x, &m.center_y, &m.k1, &m.k2, &m.focdist, &m.aperture}) {
    expect_not_written(m, *number, field++);
  }
  Buffer buffer;
  CameraConstants c;
  field = 7;
  for (double* const number : {&c.chip_width, &c.chip_height, &c.fake_chip_width, &c.fake_chip_height}) {
    *number = nan;
    const std::string expected = "not finite at " + std::to_string(field++);
    EXPECT_EQ(fault_of(encode(c, {Encoding::ascii, {}}, buffer)), expected);
    EXPECT_EQ(fault_of(encode(c, {Encoding::binary, {}}, buffer)), expected);
    *number = 1;
  }
}

/// The transform that the format does not select is not written, so it may have any value.
TEST(Faults, ValuesThatAreNotWrittenAreNotChecked) {
  CameraParams p;
  p.format = euler;
  p.matrix.fill(nan);
  Buffer buffer;
  EXPECT_EQ(fault_of(encode(p, {Encoding::binary, {}}, buffer)), "no fault");
  EXPECT_EQ(fault_of(encode(p, {Encoding::ascii, {}}, buffer)), "no fault");
  p = {};
  p.euler.x = nan;
  EXPECT_EQ(fault_of(encode(p, {Encoding::binary, {}}, buffer)), "no fault");
}

TEST(Faults, NumbersThatAreNotFiniteAreNotRead) {
  RandomRecords random(4);
  for (const std::uint32_t format : {0x11U, 0x12U}) {
    for (const Abi abi : {Abi::lp64, Abi::i386}) {
      for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
        const Layout layout{Generation::identified, abi, order};
        const std::string good = encoded(random.params(format), {Encoding::binary, layout});
        for (std::size_t i = 0; i < 23; ++i) {
          std::string bad = good;
          const std::string bytes = order == ByteOrder::big ? "\x7F\xF8\0\0\0\0\0\0"s : "\0\0\0\0\0\0\xF8\x7F"s;
          bad.replace(header_size + 8 + 8 * i, 8, bytes);
          const bool is_euler = format == 0x11;
          const int lens = (is_euler ? 8 : 14) + static_cast<int>(i) - 16;
          const int field = i >= 16 ? lens : is_euler ? (i < 6 ? 2 + static_cast<int>(i) : no_field) : matrix_places[i];
          const std::string expected = field == no_field ? "no fault" : "not finite at " + std::to_string(field);
          EXPECT_EQ(decode_fault(bad), expected) << "number " << i << ", " << describe(layout);
          EXPECT_EQ(decode_fault(bad, {Generation::identified, {}, order}), expected) << "number " << i;
        }
      }
    }
  }
}

TEST(Faults, NumbersOfConstantsThatAreNotFiniteAreNotRead) {
  RandomRecords random(6);
  const std::string good =
      encoded(random.constants(), {Encoding::binary, {Generation::document, Abi::lp64, ByteOrder::little}});
  for (std::size_t i = 0; i < 4; ++i) {
    std::string bad = good;
    bad.replace(header_size + 24 + 8 * i, 8, "\0\0\0\0\0\0\xF0\xFF"s);
    EXPECT_EQ(decode_fault(bad), "not finite at " + std::to_string(7 + i));
  }
}

TEST(Faults, ATooLargeCounterIsNotWritten) {
  CameraParams p;
  p.counter = 0x100000000;
  Buffer buffer;
  for (const Abi abi : {Abi::llp64, Abi::i386}) {
    p.format = 0;
    EXPECT_EQ(fault_of(encode(p, {Encoding::binary, {Generation::identified, abi, {}}}, buffer)), "out of range at 21");
    p.format = euler;
    EXPECT_EQ(fault_of(encode(p, {Encoding::binary, {Generation::document, abi, {}}}, buffer)), "out of range at 15");
  }
  EXPECT_EQ(fault_of(encode(p, {Encoding::binary, {Generation::document, Abi::lp64, {}}}, buffer)), "no fault");
}

constexpr Reason reasons[] = {Reason::too_long,     Reason::truncated,       Reason::bad_magic,
                              Reason::bad_type,     Reason::bad_encoding,    Reason::not_a_number,
                              Reason::out_of_range, Reason::not_finite,      Reason::trailing_text,
                              Reason::wrong_size,   Reason::layout_mismatch, Reason::no_valid_layout};

TEST(FaultNames, AreShortDistinctAndExplained) {
  std::set<std::string> names, lines;
  for (const Reason reason : reasons) {
    EXPECT_TRUE(names.insert(name(reason)).second) << name(reason);
    const std::string line = describe({reason});
    EXPECT_EQ(line.find(name(reason)), 0U) << line;
    EXPECT_TRUE(lines.insert(line).second) << line;
  }
}

TEST(FaultNames, SayTheField) {
  EXPECT_EQ(describe({Reason::not_a_number, 9, true}), "field 9 is not a number");
  EXPECT_EQ(describe({Reason::out_of_range, 0, true}), "the id does not fit its type");
  EXPECT_EQ(describe({Reason::truncated, 15, true}), "field 15 is missing");
  EXPECT_EQ(describe({Reason::not_finite, 5, true}), "field 5 is not finite");
  EXPECT_EQ(describe({Reason::bad_magic}), "bad magic: does not begin with DMC01 and a NUL");
}

}  // namespace trk_bridge::wire::fault_test
