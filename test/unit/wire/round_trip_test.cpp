// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "records.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire::round_trip_test {

using test::bits_of;
using test::encoded;
using test::RandomRecords;

using namespace std::string_literals;

constexpr Generation generations[] = {Generation::document, Generation::identified};
constexpr Abi abis[] = {Abi::lp64, Abi::llp64, Abi::i386};
constexpr ByteOrder byte_orders[] = {ByteOrder::little, ByteOrder::big};

template <class Visit>
void for_all_layouts(Visit visit) {
  for (const Generation generation : generations) {
    for (const Abi abi : abis) {
      for (const ByteOrder byte_order : byte_orders) visit(Layout{generation, abi, byte_order});
    }
  }
}

LayoutDetector given(Layout layout) {
  return LayoutDetector(LayoutChoice{layout.generation, layout.abi, layout.byte_order});
}

template <class T>
void expect_back(const T& record, WireForm form) {
  LayoutDetector detector = given(form.layout);
  const std::string datagram = encoded(record, form);
  const auto read = decode(datagram, detector);
  ASSERT_TRUE(read) << describe(read.error()) << ", " << describe(form.layout);
  EXPECT_EQ(read->form.encoding, form.encoding);
  T expected = record;
  if (form.encoding == Encoding::binary) {
    EXPECT_EQ(read->form.layout, form.layout);
    if (form.layout.generation == Generation::document) expected.id = 0;
  }
  EXPECT_EQ(bits_of(read->record), bits_of(expected)) << describe(form.layout);
  EXPECT_EQ(encoded(std::get<T>(read->record), form), datagram);
}

TEST(RoundTrip, ParamsInAllMasksAndLayouts) {
  RandomRecords random(1998);
  for (std::uint32_t mask = 0; mask <= known_format_bits; ++mask) {
    CameraParams p = random.params(mask);
    p.id = random.whole(0, 4);
    expect_back(p, {Encoding::ascii, {}});
    for_all_layouts([&p](Layout layout) { expect_back(p, {Encoding::binary, layout}); });
    ASSERT_FALSE(HasFailure()) << "mask " << mask;
  }
}

TEST(RoundTrip, Constants) {
  RandomRecords random(1999);
  for (std::uint32_t id = 0; id < 50; ++id) {
    CameraConstants c = random.constants();
    c.id = id;
    expect_back(c, {Encoding::ascii, {}});
    for_all_layouts([&c](Layout layout) { expect_back(c, {Encoding::binary, layout}); });
  }
}

TEST(RoundTrip, Extremes) {
  CameraParams p;
  p.id = 0xFFFFFFFF;
  p.format = 0xFFFFFFFF;
  p.euler = {-0.0, 4.9406564584124654e-324, -1.7976931348623157e308, 2.2250738585072014e-308, 0.1, -1e22};
  p.counter = 0xFFFFFFFF;
  CameraConstants c;
  c.id = 0xFFFFFFFF;
  c.image_width = 2147483647;
  c.blank_left = -2147483647 - 1;
  c.chip_width = 1e-320;
  expect_back(p, {Encoding::ascii, {}});
  expect_back(c, {Encoding::ascii, {}});
  for_all_layouts([&](Layout layout) {
    expect_back(p, {Encoding::binary, layout});
    expect_back(c, {Encoding::binary, layout});
  });
  p.counter = 0xFFFFFFFFFFFFFFFF;
  expect_back(p, {Encoding::ascii, {}});
  expect_back(p, {Encoding::binary, {Generation::identified, Abi::lp64, ByteOrder::big}});
}

TEST(RoundTrip, BigEndianIsTheMirrorOfLittleEndian) {
  CameraParams p;
  p.id = 0x01020304;
  p.counter = 0x05060708;
  const std::string bytes = encoded(p, {Encoding::binary, {Generation::identified, Abi::lp64, ByteOrder::big}});
  EXPECT_EQ(bytes.substr(header_size, 4), std::string("\1\2\3\4"));
  EXPECT_EQ(bytes.substr(header_size + 192), "\0\0\0\0\5\6\7\10"s);
}

TEST(RoundTrip, AsciiIsThatOfTheWireFormat) {
  CameraParams p;
  p.format = 0x211;
  p.euler = {1.5, -2, 1.75, 30, -5, 0};
  p.fov = 42;
  p.center_x = 0.1;
  p.k1 = -0.001;
  p.focdist = 4.5;
  p.counter = 1234;
  EXPECT_EQ(encoded(p, {Encoding::ascii, {}}), "DMC01\0PA211 1.5 -2 1.75 30 -5 0 42 0.1 0 -0.001 0 4.5 0 1234\0"s);
  p.id = 7;
  p.format = 0x2AF;
  EXPECT_EQ(encoded(p, {Encoding::ascii, {}}).substr(8, 7), "I7 2AF ");
  CameraConstants c;
  c.image_width = 720;
  c.blank_left = -3;
  c.chip_width = 8.8;
  EXPECT_EQ(encoded(c, {Encoding::ascii, {}}), "DMC01\0CA720 0 -3 0 0 0 8.8 0 0 0\0"s);
}

TEST(RoundTrip, TheMatrixInTextIsColumnMajor) {
  CameraParams p;
  for (std::size_t i = 0; i < 16; ++i) p.matrix[i] = static_cast<double>(i);
  p.matrix[3] = p.matrix[7] = p.matrix[11] = 0;
  p.matrix[15] = 1;
  Buffer buffer;
  const auto text = to_text(p, buffer);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "0 0 1 2 4 5 6 8 9 10 12 13 14 0 0 0 0 0 0 0 0");
  const auto read = params_from_text(*text);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, p);
}

TEST(RoundTrip, ImagesAreDatagramsWithoutHeader) {
  RandomRecords random(7);
  for_all_layouts([&random](Layout layout) {
    const CameraParams p = random.params(euler);
    const CameraConstants c = random.constants();
    Buffer buffer;
    const auto params_image = to_image(p, layout, buffer);
    ASSERT_TRUE(params_image);
    EXPECT_EQ(params_image->size(), params_size(layout));
    EXPECT_EQ(*params_image, encoded(p, {Encoding::binary, layout}).substr(header_size));
    EXPECT_EQ(params_from_image(*params_image, layout), p);
    const auto constants_image = to_image(c, layout, buffer);
    ASSERT_TRUE(constants_image);
    EXPECT_EQ(constants_image->size(), constants_size(layout));
    EXPECT_EQ(constants_from_image(*constants_image, layout), c);
  });
}

TEST(Record, OnlyTheTransformThatTheFormatSelectsIsCompared) {
  CameraParams a, b;
  b.euler.x = 1;
  EXPECT_EQ(a, b);
  a.format = b.format = euler;
  EXPECT_NE(a, b);
  b = a;
  b.matrix[0] = 1;
  EXPECT_EQ(a, b);
  a.format = b.format = 0;
  EXPECT_NE(a, b);
  b = a;
  b.aperture = 4;
  EXPECT_NE(a, b);
}

TEST(Rigid, IsARotationAboveItsBottomRow) {
  RandomRecords random(11);
  const std::array<double, 16> rigid = random.matrix();
  EXPECT_TRUE(is_rigid(rigid));
  for (std::size_t i = 0; i < 12; ++i) {
    auto bent = rigid;
    bent[i] += 0.1;
    EXPECT_FALSE(is_rigid(bent)) << i;
  }
  auto scaled = rigid;
  for (std::size_t i = 0; i < 12; ++i) scaled[i] *= 1.002;
  EXPECT_FALSE(is_rigid(scaled));
  auto mirrored = rigid;
  for (std::size_t i = 0; i < 3; ++i) mirrored[i] = -mirrored[i];
  EXPECT_FALSE(is_rigid(mirrored));
  auto moved = rigid;
  moved[12] = 1e6;
  EXPECT_TRUE(is_rigid(moved));
  auto perspective = rigid;
  perspective[3] = 1;
  EXPECT_FALSE(is_rigid(perspective));
  auto nan = rigid;
  nan[0] = std::nan("");
  EXPECT_FALSE(is_rigid(nan));
}

}  // namespace trk_bridge::wire::round_trip_test
