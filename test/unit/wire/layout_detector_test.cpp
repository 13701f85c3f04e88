// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Detection of layouts from records.
#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "records.h"
#include "trk_bridge/wire/codec.h"
#include "vectors.h"

namespace trk_bridge::wire::layout_detector_test {

using test::bits_of;
using test::encoded;
using test::RandomRecords;

constexpr Layout layout(Generation generation, Abi abi, ByteOrder order = ByteOrder::little) {
  return {generation, abi, order};
}
constexpr Layout document_lp64 = layout(Generation::document, Abi::lp64);
constexpr Layout identified_lp64 = layout(Generation::identified, Abi::lp64);

std::vector<Layout> all_layouts() {
  std::vector<Layout> layouts;
  for (const Generation generation : {Generation::document, Generation::identified}) {
    for (const Abi abi : {Abi::lp64, Abi::llp64, Abi::i386}) {
      for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) layouts.push_back({generation, abi, order});
    }
  }
  return layouts;
}

template <class T>
std::string binary(const T& record, Layout as) {
  return encoded(record, {Encoding::binary, as});
}

/// A 4-byte word of the image, stored in the layout's byte order.
void put_word(std::string& datagram, std::size_t offset, std::uint32_t word, ByteOrder order) {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t at = order == ByteOrder::big ? 3 - i : i;
    datagram[header_size + offset + at] = static_cast<char>(word >> 8 * i);
  }
}

/// The datagram with `word` in all padding of its layout, and in the part of the union that Euler angles do not use.
std::string with_padding(std::string datagram, const CameraParams& p, Layout as, std::uint32_t word) {
  const auto data = test::bytes_with_data(p, as);
  for (std::size_t offset = 0; offset + 4 <= data.size(); offset += 4) {
    if (!data[offset]) put_word(datagram, offset, word, as.byte_order);
  }
  return datagram;
}

void expect_read(const std::string& datagram, LayoutDetector& detector, const CameraParams& expected, Layout as) {
  const auto read = decode(datagram, detector);
  ASSERT_TRUE(read) << describe(read.error()) << ", " << describe(as);
  EXPECT_EQ(bits_of(read->record), bits_of(expected)) << describe(as) << ", read as " << describe(read->form.layout);
}

const std::uint32_t masks_without_doubt[] = {0x001, 0x011, 0x013, 0x3BF, 0x012, 0x01E, 0x092, 0x200, 0x010};

TEST(LayoutDetector, FindsEveryLayoutFromOneRecord) {
  RandomRecords random(1);
  for (const Layout as : all_layouts()) {
    for (const std::uint32_t mask : masks_without_doubt) {
      const CameraParams p = random.params(mask);
      LayoutDetector detector;
      expect_read(binary(p, as), detector, p, as);
      ASSERT_TRUE(detector.seen());
      EXPECT_EQ(detector.seen()->generation, as.generation) << describe(as) << ", mask " << mask;
      EXPECT_EQ(detector.seen()->byte_order, as.byte_order) << describe(as) << ", mask " << mask;
    }
  }
}

TEST(LayoutDetector, FindsEveryMaskOnceConstantsWereSeen) {
  RandomRecords random(2);
  for (const Layout as : all_layouts()) {
    LayoutDetector detector;
    ASSERT_TRUE(decode(binary(random.constants(), as), detector));
    for (std::uint32_t mask = 0; mask <= known_format_bits; ++mask) {
      const CameraParams p = random.params(mask);
      const auto read = decode(binary(p, as), detector);
      ASSERT_TRUE(read) << describe(as) << ", mask " << mask;
      ASSERT_EQ(bits_of(read->record), bits_of(p)) << describe(as) << ", mask " << mask;
      EXPECT_EQ(read->form.layout.generation, as.generation);
      EXPECT_EQ(read->form.layout.byte_order, as.byte_order);
      EXPECT_FALSE(read->layout_guessed);
    }
  }
}

TEST(LayoutDetector, FindsIdentifiedCamerasOfAnyNumber) {
  RandomRecords random(3);
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    const Layout as = layout(Generation::identified, Abi::lp64, order);
    for (const std::uint32_t mask : {0x001U, 0x011U, 0x012U, 0x3BFU, 0x090U}) {
      for (std::uint32_t id = 0; id < 300; ++id) {
        CameraParams p = random.params(mask);
        p.id = id;
        LayoutDetector detector;
        expect_read(binary(p, as), detector, p, as);
      }
    }
  }
}

TEST(LayoutDetector, TheDefaultFormatOfLowNumberedCamerasIsIdentified) {
  RandomRecords random(4);
  for (std::uint32_t id = 1; id < 16; ++id) {
    CameraParams p = random.params(0);
    p.id = id;
    LayoutDetector detector;
    const auto read = decode(binary(p, identified_lp64), detector);
    ASSERT_TRUE(read);
    EXPECT_EQ(bits_of(read->record), bits_of(p)) << id;
    // An odd number would be the word `euler`, but the record contains a matrix.
    EXPECT_EQ(read->layout_guessed, id % 2 == 0) << id;
  }
}

TEST(LayoutDetector, AMatrixFormatBeforeAZeroIsGuessedAsDocument) {
  RandomRecords random(5);
  const CameraParams p = random.params(0x12);
  LayoutDetector detector;
  const auto guess = decode(binary(p, document_lp64), detector);
  ASSERT_TRUE(guess);
  EXPECT_EQ(bits_of(guess->record), bits_of(p));
  EXPECT_TRUE(guess->layout_guessed);

  CameraParams camera_18 = random.params(0);
  camera_18.id = 0x12;
  ASSERT_TRUE(decode(binary(random.constants(), identified_lp64), detector));
  const auto known = decode(binary(camera_18, identified_lp64), detector);
  ASSERT_TRUE(known);
  EXPECT_EQ(bits_of(known->record), bits_of(camera_18));
  EXPECT_FALSE(known->layout_guessed);
}

TEST(LayoutDetector, ARecordThatOnlyOneGenerationCanReadDecidesForTheNextOnes) {
  RandomRecords random(6);
  LayoutDetector detector;
  const CameraParams certain = random.params(euler);
  expect_read(binary(certain, document_lp64), detector, certain, document_lp64);
  const CameraParams doubtful = random.params(camera_y_up);
  const auto read = decode(binary(doubtful, document_lp64), detector);
  ASSERT_TRUE(read);
  EXPECT_EQ(bits_of(read->record), bits_of(doubtful));
  EXPECT_FALSE(read->layout_guessed);
}

TEST(LayoutDetector, TheOnlyReadingThatFitsHasPriorityOverTheConstants) {
  RandomRecords random(7);
  LayoutDetector detector;
  ASSERT_TRUE(decode(binary(random.constants(), identified_lp64), detector));
  const CameraParams document = random.params(0x11);
  expect_read(binary(document, document_lp64), detector, document, document_lp64);
  ASSERT_TRUE(decode(binary(random.constants(), document_lp64), detector));
  const CameraParams identified = random.params(0x11);
  expect_read(binary(identified, identified_lp64), detector, identified, identified_lp64);
}

TEST(LayoutDetector, ASingleZeroFormatMeansTheSameInBothGenerations) {
  RandomRecords random(8);
  const CameraParams p = random.params(0);
  LayoutDetector detector;
  const auto read = decode(binary(p, document_lp64), detector);
  ASSERT_TRUE(read);
  EXPECT_EQ(bits_of(read->record), bits_of(p));
  EXPECT_FALSE(read->layout_guessed);
}

TEST(LayoutDetector, PaddingMayHaveAnyValue) {
  RandomRecords random(9);
  for (const Layout as : all_layouts()) {
    for (const std::uint32_t word : {0xDEADBEEFU, 0xCCCCCCCCU, 0xFFFFFFFFU, 0x7FF80000U, 0x00400000U}) {
      for (const std::uint32_t mask : {0x011U, 0x3BFU, 0x012U, 0x01EU}) {
        const CameraParams p = random.params(mask);
        const std::string datagram = with_padding(binary(p, as), p, as, word);
        LayoutDetector fresh;
        expect_read(datagram, fresh, p, as);
        LayoutDetector given({as.generation, as.abi, as.byte_order});
        expect_read(datagram, given, p, as);
      }
    }
  }
}

TEST(LayoutDetector, AStaleMatrixBehindEulerAnglesIsIgnored) {
  RandomRecords random(10);
  CameraParams p = random.params(0x11);
  p.euler.pan = 0;
  for (const Layout as : all_layouts()) {
    std::string datagram = binary(p, as);
    CameraParams matrix;
    matrix.matrix = random.matrix();
    const std::string stale = binary(matrix, as);
    const std::size_t begin = header_size + (as.abi == Abi::i386 && as.generation == Generation::document ? 4 : 8);
    datagram.replace(begin + 48, 80, stale, begin + 48, 80);
    LayoutDetector detector;
    expect_read(datagram, detector, p, as);
  }
}

TEST(LayoutDetector, AMatrixNeedNotBeARotation) {
  RandomRecords random(11);
  for (const Layout as : all_layouts()) {
    for (const double scale : {1.002, 0.5, 1000.0}) {
      CameraParams p = random.params(0x12);
      for (std::size_t i = 0; i < 12; ++i) p.matrix[i] *= scale;
      LayoutDetector detector;
      expect_read(binary(p, as), detector, p, as);
      if (as.generation == Generation::document) continue;
      p.id = 1;
      LayoutDetector other;
      expect_read(binary(p, as), other, p, as);
    }
  }
}

TEST(LayoutDetector, UnknownFormatBitsAreKept) {
  RandomRecords random(12);
  for (const std::uint32_t mask : {0x411U, 0x80000011U, 0x1011U}) {
    const CameraParams p = random.params(mask);
    for (const Layout as : all_layouts()) {
      LayoutDetector detector;
      expect_read(binary(p, as), detector, p, as);
    }
  }
  const CameraParams matrix = random.params(0x412);
  LayoutDetector detector;
  ASSERT_TRUE(decode(binary(random.constants(), identified_lp64), detector));
  expect_read(binary(matrix, identified_lp64), detector, matrix, identified_lp64);
}

TEST(LayoutDetector, RecordsThatFitNoLayoutAreRefused) {
  std::string datagram = std::string("DMC01\0PB", 8) + std::string(200, '\x5A');
  for (const std::size_t size : {192U, 196U, 200U}) {
    LayoutDetector detector;
    const auto read = decode(datagram.substr(0, header_size + size), detector);
    ASSERT_FALSE(read) << size;
    EXPECT_EQ(read.error().reason, Reason::no_valid_layout);
    EXPECT_FALSE(read.error().about_field);
    EXPECT_FALSE(detector.seen());
  }
  datagram[6] = 'C';
  for (const std::size_t size : {56U, 60U, 64U}) {
    LayoutDetector detector;
    const auto read = decode(datagram.substr(0, header_size + size), detector);
    ASSERT_FALSE(read) << size;
    EXPECT_EQ(read.error().reason, Reason::no_valid_layout);
  }
}

TEST(LayoutDetector, AGivenLayoutIsNotChecked) {
  const std::string datagram = std::string("DMC01\0PB", 8) + std::string(200, '\x5A');
  LayoutDetector detector({Generation::identified, Abi::lp64, ByteOrder::little});
  const auto read = decode(datagram, detector);
  ASSERT_TRUE(read) << describe(read.error());
  const auto& p = std::get<CameraParams>(read->record);
  EXPECT_EQ(p.id, 0x5A5A5A5AU);
  EXPECT_EQ(p.format, 0x5A5A5A5AU);
  EXPECT_EQ(p.counter, 0x5A5A5A5A5A5A5A5AU);
}

TEST(LayoutDetector, TheSizeOfConstantsDecides) {
  RandomRecords random(13);
  for (const Layout as : all_layouts()) {
    CameraConstants c = random.constants();
    c.id = as.generation == Generation::identified ? 3 : 0;
    LayoutDetector detector;
    const auto read = decode(binary(c, as), detector);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_EQ(bits_of(read->record), bits_of(c)) << describe(as);
    EXPECT_EQ(read->form.layout.generation, as.generation);
    EXPECT_EQ(read->form.layout.byte_order, as.byte_order);
    EXPECT_EQ(constants_size(read->form.layout), constants_size(as));
  }
}

TEST(LayoutDetector, ATruncatedRecordIsNotOneOfASmallerLayout) {
  RandomRecords random(14);
  for (const Layout as : all_layouts()) {
    for (const std::uint32_t id : {0U, 1U, 2U}) {
      CameraConstants c = random.constants();
      c.id = id;
      c.blank_bottom = 0;
      const std::string whole = binary(c, as);
      for (const std::size_t size : {56U, 60U}) {
        if (size >= constants_size(as)) continue;
        LayoutDetector detector;
        EXPECT_FALSE(decode(std::string_view(whole).substr(0, header_size + size), detector))
            << describe(as) << " truncated to " << size << ", id " << id;
      }
      for (const std::uint32_t mask : {0x001U, 0x011U, 0x3BFU, 0x000U, 0x012U}) {
        CameraParams p = random.params(mask);
        p.id = id;
        if (params_size(as) == 192) continue;
        LayoutDetector detector;
        EXPECT_FALSE(decode(std::string_view(binary(p, as)).substr(0, header_size + 192), detector))
            << describe(as) << " truncated to 192, mask " << mask << ", id " << id;
      }
    }
  }
}

std::uint64_t counter_read(const std::string& datagram, LayoutDetector& detector) {
  const auto read = decode(datagram, detector);
  if (!read) throw std::runtime_error(describe(read.error()));
  return std::get<CameraParams>(read->record).counter;
}

std::string with_counter(std::uint64_t counter, Layout as) {
  CameraParams p = RandomRecords(15).params(0x11);
  p.counter = counter;
  return binary(p, as);
}

TEST(CounterWidth, FourBytesBeforePadding) {
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    const Layout as = layout(Generation::identified, Abi::llp64, order);
    LayoutDetector detector;
    for (const std::uint32_t counter : {1U, 2U, 77U, 0xFFFFFFFEU, 0xFFFFFFFFU, 0U, 1U}) {
      std::string datagram = with_counter(counter, as);
      put_word(datagram, 196, 0xCDCDCDCD, order);
      EXPECT_EQ(counter_read(datagram, detector), counter) << describe(as);
      EXPECT_EQ(detector.seen()->abi, Abi::llp64);
    }
  }
}

TEST(CounterWidth, EightBytesBelowTheLimitAreTheSame) {
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    const Layout as = layout(Generation::identified, Abi::lp64, order);
    LayoutDetector detector;
    for (const std::uint32_t counter : {0U, 1U, 0xFFFFFFFFU}) {
      EXPECT_EQ(counter_read(with_counter(counter, as), detector), counter);
      EXPECT_EQ(detector.seen()->abi, Abi::lp64);
    }
  }
}

TEST(CounterWidth, EightBytesSeenToWrapStayEight) {
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    const Layout as = layout(Generation::identified, Abi::lp64, order);
    LayoutDetector detector;
    for (const auto counter : {0xFFFFFFFEULL, 0x100000001ULL, 0x100000002ULL, 0x500000000ULL}) {
      EXPECT_EQ(counter_read(with_counter(counter, as), detector), counter) << describe(as);
      EXPECT_EQ(detector.seen()->abi, Abi::lp64);
    }
  }
}

TEST(CounterWidth, AGivenAbiIsUsed) {
  const std::string datagram = with_counter(0xCDCDCDCD00000007, identified_lp64);
  LayoutDetector wide({{}, Abi::lp64, {}});
  EXPECT_EQ(counter_read(datagram, wide), 0xCDCDCDCD00000007U);
  LayoutDetector narrow({{}, Abi::llp64, {}});
  EXPECT_EQ(counter_read(datagram, narrow), 7U);
  EXPECT_EQ(narrow.seen()->abi, Abi::llp64);
}

struct FieldSet {
  const char* folder;
  Layout as;
};
const FieldSet field_sets[] = {{"document_lp64", document_lp64},
                               {"identified_lp64", identified_lp64},
                               {"document_i386", layout(Generation::document, Abi::i386)},
                               {"identified_i386", layout(Generation::identified, Abi::i386)}};

std::vector<std::pair<std::string, CameraParams>> field_params(const FieldSet& set) {
  std::vector<std::pair<std::string, CameraParams>> all;
  for (const auto& line : test::read_jsonl(std::string("field/") + set.folder + "/params.jsonl")) {
    all.emplace_back(test::from_hex(line["binary_hex"].GetString()), test::params_of(line["fields"]));
  }
  return all;
}

TEST(FieldSets, WithTheirConstantsSeenFirst) {
  for (const FieldSet& set : field_sets) {
    LayoutDetector detector;
    const auto constants = test::read_jsonl(std::string("field/") + set.folder + "/constants.jsonl");
    ASSERT_TRUE(decode(test::from_hex(constants[0]["binary_hex"].GetString()), detector));
    for (const auto& [datagram, fields] : field_params(set)) {
      const auto read = decode(datagram, detector);
      ASSERT_TRUE(read);
      EXPECT_EQ(bits_of(read->record), bits_of(fields));
      EXPECT_EQ(read->form.layout, set.as);
      EXPECT_FALSE(read->layout_guessed);
    }
  }
}

TEST(FieldSets, WithoutConstantsInAnyOrder) {
  for (const FieldSet& set : field_sets) {
    auto all = field_params(set);
    for (unsigned seed = 0; seed < 20; ++seed) {
      std::shuffle(all.begin(), all.end(), std::mt19937(seed));
      LayoutDetector detector;
      for (const auto& [datagram, fields] : all) expect_read(datagram, detector, fields, set.as);
    }
  }
}

TEST(FieldSets, AsBigEndianAndAsWindowsWouldSendThem) {
  for (const FieldSet& set : field_sets) {
    for (const Abi abi : {set.as.abi, Abi::llp64}) {
      const Layout as = layout(set.as.generation, abi, ByteOrder::big);
      LayoutDetector detector;
      for (const auto& [datagram, fields] : field_params(set)) {
        const std::string clean = binary(fields, as);
        expect_read(clean, detector, fields, as);
        LayoutDetector fresh;
        expect_read(with_padding(clean, fields, as, 0xCDCDCDCD), fresh, fields, as);
      }
    }
  }
}

}  // namespace trk_bridge::wire::layout_detector_test
