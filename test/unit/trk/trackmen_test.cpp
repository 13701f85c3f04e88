// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// TrackMen's packet of 124 bytes.
#include "trk/trackmen.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "exact_copy.h"
#include "trk/datagram_decoder.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::trk::trackmen_test {

using testing::HasSubstr;

/// Worked out by hand, all little-endian: magic 0x544D4531; four unknown bytes; counter 0x01020304; then the doubles x
/// 1.5, y -2, z 1.75, pan 30, tilt -5, roll 0.25, horizontal angle of view 90, centre 0.5 and -0.25 mm, k1 0.0009765625
/// (2^-10), k2 -2^-20, focus 4.5 m, chip 9.5 by 5.5 mm. A double is sign, 11 bits of exponent + 1023, 52 of mantissa:
/// 1.5 = 1.1b * 2^0 = 3FF8..., 30 = 1.111b * 2^4 = 403E..., 90 = 1.01101b * 2^6 = 40568...
std::string packet() {
  return test::from_hex(
      "31454d54"
      "efbeadde"
      "04030201"
      "000000000000f83f"
      "00000000000000c0"
      "000000000000fc3f"
      "0000000000003e40"
      "00000000000014c0"
      "000000000000d03f"
      "0000000000805640"
      "000000000000e03f"
      "000000000000d0bf"
      "000000000000503f"
      "000000000000b0be"
      "0000000000001240"
      "0000000000002340"
      "0000000000001640");
}

TEST(TrackMen, ThePacketIsARecord) {
  DatagramDecoder decoder({});
  transport::Sample sample;
  sample.has_counter = sample.has_lens = false;
  transport::Fault fault;
  const std::string bytes = packet();
  decoder.begin(bytes, {});
  ASSERT_EQ(decoder.next(sample, fault), transport::Decoder::Next::sample) << describe(fault);
  EXPECT_STREQ(sample.origin, "binary trackmen");
  EXPECT_TRUE(sample.has_counter && sample.has_lens);
  const auto& p = std::get<wire::CameraParams>(sample.record);
  EXPECT_EQ(p.id, 0u);
  EXPECT_EQ(p.format, wire::euler);
  EXPECT_EQ(p.counter, 0x01020304u);
  EXPECT_EQ(p.euler.x, 1.5);
  EXPECT_EQ(p.euler.y, -2);
  EXPECT_EQ(p.euler.z, 1.75);
  EXPECT_EQ(p.euler.pan, 30);
  EXPECT_EQ(p.euler.tilt, -5);
  EXPECT_EQ(p.euler.roll, 0.25);
  EXPECT_NEAR(p.fov, 4.75, 1e-12) << "half of the chip's width at 45 degrees";
  EXPECT_EQ(p.center_x, 0.5);
  EXPECT_EQ(p.center_y, -0.25);
  EXPECT_EQ(p.k1, std::ldexp(1, -10));
  EXPECT_EQ(p.k2, -std::ldexp(1, -20));
  EXPECT_EQ(p.focdist, 4.5);
  EXPECT_EQ(p.aperture, 0);
  EXPECT_TRUE(camera::decode(p, nullptr)) << "it needs no constants";
  EXPECT_EQ(decoder.next(sample, fault), transport::Decoder::Next::none);
}

std::string fault_of(const std::string& datagram) {
  const auto params = trackmen_params(datagram);
  return params ? "no fault" : wire::describe(params.error());
}

std::string with(std::size_t number, double value) {
  std::string bytes = packet();
  std::memcpy(&bytes[12 + 8 * number], &value, sizeof value);
  return bytes;
}

TEST(TrackMen, FaultsNameTheField) {
  EXPECT_THAT(fault_of(packet().substr(0, 123)), HasSubstr("wrong size"));
  EXPECT_THAT(fault_of(packet() + '\0'), HasSubstr("wrong size"));
  EXPECT_EQ(fault_of(with(0, std::nan(""))), "field 2 is not finite") << "x: as in ASCII records";
  EXPECT_EQ(fault_of(with(11, INFINITY)), "field 13 is not finite") << "the focus distance";
  EXPECT_EQ(fault_of(with(12, INFINITY)), "field 16 is not finite") << "the chip's width";
  EXPECT_EQ(fault_of(with(13, std::nan(""))), "field 17 is not finite");
  EXPECT_EQ(fault_of(with(6, 0)), "field 8 does not fit its type");
  EXPECT_EQ(fault_of(with(6, 180)), "field 8 does not fit its type");
  EXPECT_EQ(fault_of(with(12, 0)), "field 16 does not fit its type");
  EXPECT_FALSE(is_trackmen("1EM"));
  EXPECT_FALSE(is_trackmen("DMC01"));
}

TEST(TrackMen, DamagedPacketsAreFaultsOrFinite) {
  std::mt19937 random(124);
  for (int i = 0; i < 10000; ++i) {
    std::string bad = packet();
    for (unsigned n = 1 + random() % 4; n > 0; --n) {
      char& byte = bad[4 + random() % 120];
      byte = static_cast<char>(byte ^ static_cast<char>(1U << random() % 8));
    }
    if (i % 5 == 0) bad.resize(4 + random() % 200);
    const test::ExactCopy copy(bad);
    const auto params = trackmen_params(copy.view());
    ASSERT_TRUE(!params || bad.size() == 124);
    if (!params) continue;
    ASSERT_TRUE(camera::decode(*params, nullptr)) << i;
  }
}

}  // namespace trk_bridge::trk::trackmen_test
