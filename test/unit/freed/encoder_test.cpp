// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "freed/encoder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "camera_records.h"
#include "freed/decoder.h"
#include "freed_messages.h"
#include "trk_bridge/camera/camera.h"

namespace trk_bridge::freed::encoder_test {

using test::bytes;
using test::table_of;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// The only datagram of the record, or the fault.
std::string datagram_of(Encoder& encoder, const wire::CameraParams& params) {
  if (const auto begun = encoder.begin(params); !begun) return describe(begun.error());
  const auto datagram = encoder.next();
  if (!datagram) return "no datagram";
  const std::string copy(*datagram);
  EXPECT_FALSE(encoder.next()) << "one datagram a record";
  return copy;
}
std::string datagram_of(const wire::CameraParams& params, EncoderOptions options = {}) {
  Encoder encoder(std::move(options));
  return datagram_of(encoder, params);
}

wire::CameraParams looking(double pan, double tilt = 0, double roll = 0) {
  auto params = test::params(1, 7);
  params.euler = {0, 0, 0, pan, tilt, roll};
  return params;
}

/// Free-D's degrees in the datagram.
double pan_in(const std::string& datagram) {
  const auto message = read(datagram);
  if (!message) {
    ADD_FAILURE() << datagram;
    return 0;
  }
  return message->message.pan / 32768.0;
}

TEST(FreeDEncoder, TheWorkedPoseInZcamsUnits) {
  // The pose of worked_message(), which derives its bytes. 9.5 mm is 950 = 0x0003B6, 1.23 m is 12300 = 0x00300C, F2.8
  // is 280 = 0x118 and the frame's number 0. The sum of the bytes up to the height is 0x5DB; 0x5DB + 0x03 + 0xB6 + 0x30
  // + 0x0C + 0x01 + 0x18 = 0x6E9, the checksum (0x40 - 0xE9) mod 256 = 0x57.
  wire::CameraParams p;
  p.id = 7;
  p.format = wire::euler;
  p.euler = {1.5, -2.0005, 1.75, -30, -5.5, 0.25};
  p.fov = 9.5;
  p.focdist = 1.23;
  p.aperture = 2.8;
  const auto expected = bytes({0xD1, 0x07, 0x0F, 0x00, 0x00, 0xFD, 0x40, 0x00, 0x00, 0x20, 0x00, 0x01, 0x77, 0x00, 0xFE,
                               0x0B, 0xE0, 0x01, 0xB5, 0x80, 0x00, 0x03, 0xB6, 0x00, 0x30, 0x0C, 0x01, 0x18, 0x57});
  Encoder encoder({Profile::zcam, nullptr, true});
  EXPECT_EQ(datagram_of(encoder, p), expected);
  EXPECT_EQ(static_cast<unsigned char>(datagram_of(encoder, p)[26]), 0x11) << "the next frame's number";
}

TEST(FreeDEncoder, TheEndsOfTheRanges) {
  wire::CameraParams p = test::params(1, 255);
  p.euler = {-131.072, 131.071984375, -0.000015625, 180, 90, 256};
  auto expected = test::extreme_message();
  // Roll 256 is beyond, and 256 - 360 = -104: -104 * 32768 = -0x340000, 0xCC0000. Zoom is 0: 0xC1A - 3 * 0xFF - 0x80 +
  // 0xCC = 0x969, the checksum (0x40 - 0x69) mod 256 = 0xD7.
  expected.replace(8, 3, bytes({0xCC, 0x00, 0x00}));
  expected.replace(20, 3, bytes({0x00, 0x00, 0x00}));
  expected.back() = static_cast<char>(0xD7);
  EXPECT_EQ(datagram_of(p), expected);
  p.euler.x = -131.0721;
  EXPECT_THAT(datagram_of(p), HasSubstr("x does not fit the message: allowed are -131.072"));
}

TEST(FreeDEncoder, EveryFormatGivesTheSameBytes) {
  auto p = test::params(1, 7);
  p.euler = {1.5, -2.0005, 1.75, -30, -5.5, 0.25};
  p.fov = 9.5;
  const auto constants = test::constants(1920, 7);
  const auto camera = camera::decode(p, &constants);
  ASSERT_TRUE(camera);
  const auto expected = datagram_of(p, {Profile::zcam, nullptr, true});
  ASSERT_EQ(expected.size(), message_size);
  for (const std::uint32_t format :
       {std::uint32_t{0}, std::uint32_t{wire::studio_to_camera | wire::camera_y_up | wire::studio_y_up},
        std::uint32_t{wire::euler | wire::studio_y_up | wire::field_of_view | wire::vertical | wire::ignore_blank}}) {
    auto other = camera::encode(*camera, format, &constants);
    ASSERT_TRUE(other);
    other->id = 7;
    Encoder encoder({Profile::zcam, nullptr, true});
    ASSERT_TRUE(encoder.begin(constants));
    EXPECT_FALSE(encoder.next()) << "Free-D has no constants";
    EXPECT_EQ(datagram_of(encoder, *other), expected) << format;
  }
}

TEST(FreeDEncoder, PanContinuesPast180Degrees) {
  Encoder encoder({});
  // Free-D's 170 to 250 degrees, which in trk are between -180 and 180.
  for (int pan = 170; pan <= 250; pan += 5) {
    EXPECT_EQ(pan_in(datagram_of(encoder, looking(pan > 180 ? 360 - pan : -pan))), pan);
  }
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(360 - 255))), 255);
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(360 - 260))), -100) << "256 is out of range";
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(360 - 255))), -105) << "it continues from there";
}

TEST(FreeDEncoder, CamerasAreUnwrappedEachByItself) {
  Encoder encoder({});
  auto other = looking(170);
  other.id = 8;
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(-170))), 170);
  EXPECT_EQ(pan_in(datagram_of(encoder, other)), -170);
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(170))), 190);
}

TEST(FreeDEncoder, UnwrappingCanBeTurnedOff) {
  Encoder encoder({Profile::generic, nullptr, false});
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(-170))), 170);
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(170))), -170);
  EXPECT_EQ(pan_in(datagram_of(encoder, looking(-190))), -170);
}

TEST(FreeDEncoder, RecordsThatCannotBeWritten) {
  for (const std::uint32_t id : {0u, 256u, 4294967295u}) {
    EXPECT_THAT(datagram_of(test::params(1, id)), HasSubstr("camera number from 1 to 255")) << id;
  }
  auto p = test::params(1, 7);
  p.format = wire::euler | wire::field_of_view;
  EXPECT_EQ(datagram_of(p), camera::describe(camera::CameraReason::constants_needed));
  p = test::params(1, 7);
  p.fov = 200000;
  EXPECT_THAT(datagram_of(p, {Profile::zcam, nullptr, true}), HasSubstr("zoom does not fit"));
  p.fov = 42;
  p.euler.x = std::nan("");
  EXPECT_EQ(datagram_of(p), camera::describe(camera::CameraReason::not_finite));
  Encoder encoder({});
  auto bad = test::constants(720, 7);
  bad.chip_width = 0;
  EXPECT_FALSE(encoder.begin(bad));
}

TEST(FreeDEncoder, ValuesOutOfRangeAreNamed) {
  for (const double metres : {131.08, -131.08}) {
    std::vector<std::string> refused;
    for (double wire::Euler::*const member : {&wire::Euler::x, &wire::Euler::y, &wire::Euler::z}) {
      auto p = looking(0);
      p.euler.*member = metres;
      refused.push_back(datagram_of(p));
    }
    const std::string allowed = " does not fit the message: allowed are -131.072 to 131.07198 m";
    EXPECT_THAT(refused, UnorderedElementsAre("x" + allowed, "y" + allowed, "z" + allowed)) << metres;
  }
  auto p = test::params(1, 7);
  p.focdist = 200000;
  EXPECT_EQ(datagram_of(p, {Profile::zcam, nullptr, true}),
            "focus does not fit the message: allowed are 0 to 16777215 as the profile counts");
}

TEST(FreeDEncoder, ATableConvertsBackToCounts) {
  const auto table = table_of(R"(
points:
- {zoom: 1000, focal_length: 8}
- {zoom: 2000, focal_length: 20}
- {zoom: 4000, focal_length: 90}
focus:
- {count: 100, distance: 0.8}
- {count: 900, distance: 20}
)");
  for (const Profile profile : {Profile::generic, Profile::vizrt}) {
    for (const double zoom : {1000.0, 1500.0, 2718.0, 4000.0}) {
      const auto lens = table->lens_at({zoom, 500});
      ASSERT_TRUE(lens);
      auto p = test::params(1, 7);
      p.fov = lens->image_distance;
      p.focdist = lens->focdist;
      const auto message = read(datagram_of(p, {profile, table, true}));
      ASSERT_TRUE(message);
      const auto encoders = encoders_of(message->message, profile);
      EXPECT_EQ(encoders.zoom, static_cast<int>(zoom));
      EXPECT_EQ(encoders.focus, 500);
    }
  }
  auto p = test::params(1, 7);
  p.fov = 100;
  EXPECT_THAT(datagram_of(p, {Profile::generic, table, true}), HasSubstr("outside of the lens table"));
}

TEST(FreeDEncoder, PosesRoundTrip) {
  for (int i = 0; i < 200; ++i) {
    auto p = test::params(1, 9);
    p.euler = {i * 0.31 - 30, 7 - i * 0.2, i * 0.01, i * 1.7 - 170, i * 0.8 - 80, i * 0.9 - 90};
    Decoder decoder({});
    const std::string datagram = datagram_of(p);
    decoder.begin(datagram, {});
    transport::Sample sample;
    transport::Fault fault;
    ASSERT_EQ(decoder.next(sample, fault), transport::Decoder::Next::sample);
    const auto& e = std::get<wire::CameraParams>(sample.record).euler;
    // Half a unit of the message.
    EXPECT_NEAR(e.x, p.euler.x, 0.51e-3 / 64);
    EXPECT_NEAR(e.y, p.euler.y, 0.51e-3 / 64);
    EXPECT_NEAR(e.z, p.euler.z, 0.51e-3 / 64);
    EXPECT_NEAR(e.pan, p.euler.pan, 0.51 / 32768);
    EXPECT_NEAR(e.tilt, p.euler.tilt, 0.51 / 32768);
    EXPECT_NEAR(e.roll, p.euler.roll, 0.51 / 32768);
  }
}

}  // namespace trk_bridge::freed::encoder_test
