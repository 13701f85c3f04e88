// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// All datagrams written by existing programs are read and written again.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "records.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::wire::vectors_test {

using test::bits_of;
using test::constants_of;
using test::from_hex;
using test::params_of;
using test::read_jsonl;

struct Set {
  const char* folder;
  Layout layout;
};

const Set sets[] = {
    {"document_lp64", {Generation::document, Abi::lp64, ByteOrder::little}},
    {"identified_lp64", {Generation::identified, Abi::lp64, ByteOrder::little}},
    {"document_i386", {Generation::document, Abi::i386, ByteOrder::little}},
    {"identified_i386", {Generation::identified, Abi::i386, ByteOrder::little}},
};

class FieldVectors : public testing::TestWithParam<Set> {
 protected:
  std::vector<rapidjson::Document> params() const { return lines("params"); }
  std::vector<rapidjson::Document> constants() const { return lines("constants"); }
  Layout layout() const { return GetParam().layout; }

 private:
  std::vector<rapidjson::Document> lines(const char* what) const {
    return read_jsonl(std::string("field/") + GetParam().folder + "/" + what + ".jsonl");
  }
};

template <class T>
std::optional<T> decoded(const std::string& datagram, LayoutDetector& detector, WireForm* form = nullptr) {
  const auto result = decode(datagram, detector);
  EXPECT_TRUE(result) << describe(result.error());
  if (!result) return std::nullopt;
  EXPECT_TRUE(std::holds_alternative<T>(result->record));
  if (form != nullptr) *form = result->form;
  return std::get<T>(result->record);
}

TEST_P(FieldVectors, BinaryParamsAreReadBitForBit) {
  for (const auto& line : params()) {
    LayoutDetector fresh;
    WireForm form;
    const auto read = decoded<CameraParams>(from_hex(line["binary_hex"].GetString()), fresh, &form);
    ASSERT_TRUE(read);
    EXPECT_EQ(bits_of(*read), bits_of(params_of(line["fields"]))) << "mask " << line["mask"].GetUint();
    EXPECT_EQ(form.encoding, Encoding::binary);
    EXPECT_EQ(form.layout.abi, layout().abi);
    if (read->format != 0) {
      EXPECT_EQ(form.layout, layout()) << describe(form.layout);
    }
  }
}

TEST_P(FieldVectors, AsciiParamsAreReadLikeTheExistingReader) {
  LayoutDetector detector;
  for (const auto& line : params()) {
    WireForm form;
    const auto read = decoded<CameraParams>(from_hex(line["ascii_hex"].GetString()), detector, &form);
    ASSERT_TRUE(read);
    EXPECT_EQ(bits_of(*read), bits_of(params_of(line["ascii_parsed"]))) << "mask " << line["mask"].GetUint();
    EXPECT_EQ(form.encoding, Encoding::ascii);
  }
  EXPECT_FALSE(detector.seen());
}

TEST_P(FieldVectors, ConstantsAreReadBitForBit) {
  for (const auto& line : constants()) {
    LayoutDetector detector;
    WireForm form;
    const auto ascii = decoded<CameraConstants>(from_hex(line["ascii_hex"].GetString()), detector);
    const auto binary = decoded<CameraConstants>(from_hex(line["binary_hex"].GetString()), detector, &form);
    ASSERT_TRUE(ascii && binary);
    EXPECT_EQ(bits_of(*ascii), bits_of(constants_of(line["ascii_parsed"])));
    EXPECT_EQ(bits_of(*binary), bits_of(constants_of(line["fields"])));
    EXPECT_EQ(form.layout.generation, layout().generation);
    EXPECT_EQ(constants_size(form.layout), constants_size(layout()));
  }
}

TEST_P(FieldVectors, WrittenBinaryIsTheSameBytes) {
  Buffer buffer;
  for (const auto& line : params()) {
    const std::string expected = from_hex(line["binary_hex"].GetString());
    const auto p = params_of(line["fields"]);
    const auto written = encode(p, {Encoding::binary, layout()}, buffer);
    ASSERT_TRUE(written) << describe(written.error());
    ASSERT_EQ(written->size(), expected.size());
    const std::vector<bool> carries = test::bytes_with_data(p, layout());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (i < header_size || carries[i - header_size]) {
        EXPECT_EQ((*written)[i], expected[i]) << "mask " << p.format << ", byte " << i;
      }
    }
  }
  for (const auto& line : constants()) {
    const auto written = encode(constants_of(line["fields"]), {Encoding::binary, layout()}, buffer);
    ASSERT_TRUE(written) << describe(written.error());
    EXPECT_EQ(*written, from_hex(line["binary_hex"].GetString()));
  }
}

TEST_P(FieldVectors, WrittenAsciiReadsBackExactly) {
  Buffer buffer;
  LayoutDetector detector;
  for (const auto& line : params()) {
    const auto p = params_of(line["fields"]);
    const auto written = encode(p, {Encoding::ascii, {}}, buffer);
    ASSERT_TRUE(written) << describe(written.error());
    EXPECT_EQ(written->back(), '\0');
    const auto read = decoded<CameraParams>(std::string(*written), detector);
    ASSERT_TRUE(read);
    EXPECT_EQ(bits_of(*read), bits_of(p));
  }
  for (const auto& line : constants()) {
    const auto c = constants_of(line["fields"]);
    const auto written = encode(c, {Encoding::ascii, {}}, buffer);
    ASSERT_TRUE(written) << describe(written.error());
    const auto read = decoded<CameraConstants>(std::string(*written), detector);
    ASSERT_TRUE(read);
    EXPECT_EQ(bits_of(*read), bits_of(c));
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, FieldVectors, testing::ValuesIn(sets),
                         [](const auto& set) { return std::string(set.param.folder); });

}  // namespace trk_bridge::wire::vectors_test
