// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "freed/decoder.h"

#include <gmock/gmock.h>

#include <cmath>

#include "freed_messages.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::freed::decoder_test {

using test::message_of;
using test::table_of;
using testing::HasSubstr;
using transport::Fault;
using transport::Sample;
using Next = transport::Decoder::Next;

/// The parameters of a datagram, and in `sample` everything that belongs to them.
wire::CameraParams params_of(Decoder& decoder, const std::string& datagram, Sample& sample) {
  decoder.begin(datagram, {});
  Fault fault;
  while (decoder.next(sample, fault) == Next::sample) {
    if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) return *params;
  }
  ADD_FAILURE() << describe(fault);
  return {};
}
wire::CameraParams params_of(const std::string& datagram, DecoderOptions options = {}) {
  Decoder decoder(std::move(options));
  Sample sample;
  return params_of(decoder, datagram, sample);
}

std::string fault_of(const std::string& datagram, DecoderOptions options = {}) {
  Decoder decoder(std::move(options));
  decoder.begin(datagram, {});
  Sample sample;
  Fault fault;
  if (decoder.next(sample, fault) != Next::fault) return "no fault";
  EXPECT_EQ(decoder.next(sample, fault), Next::none);
  return std::string(fault.name()) + ": " + describe(fault);
}

TEST(FreeDDecoder, TheWorkedMessage) {
  Decoder decoder({});
  Sample sample;
  sample.sample_time = 5;
  sample.time_code = base::TimeCodeWithRate{};
  const auto p = params_of(decoder, test::worked_message(), sample);
  EXPECT_EQ(p.id, 7u);
  EXPECT_EQ(p.format, wire::euler);
  EXPECT_DOUBLE_EQ(p.euler.x, 1.5);
  EXPECT_DOUBLE_EQ(p.euler.y, -2.0005);
  EXPECT_DOUBLE_EQ(p.euler.z, 1.75);
  EXPECT_EQ(p.euler.pan, -30) << "to the right is positive in Free-D, to the left in trk";
  EXPECT_EQ(p.euler.tilt, -5.5);
  EXPECT_EQ(p.euler.roll, 0.25);
  EXPECT_FALSE(sample.has_counter);
  EXPECT_FALSE(sample.has_lens) << "counts are no lens";
  EXPECT_EQ(p.fov, 0);
  EXPECT_EQ(sample.encoders, (transport::LensEncoders{74565, 703710, {}}));
  EXPECT_STREQ(sample.doubt, "");
  EXPECT_FALSE(sample.sample_time || sample.time_code);
}

TEST(FreeDDecoder, TheEndsOfTheRanges) {
  const auto p = params_of(test::extreme_message());
  EXPECT_EQ(p.id, 255u);
  EXPECT_EQ(p.euler.pan, 180);
  EXPECT_EQ(p.euler.tilt, 90);
  EXPECT_EQ(p.euler.roll, -256);
  EXPECT_DOUBLE_EQ(p.euler.x, -131.072);
  EXPECT_DOUBLE_EQ(p.euler.y, 131.071984375);
  EXPECT_DOUBLE_EQ(p.euler.z, -0.000015625);
}

TEST(FreeDDecoder, ZeroIsNotMinusZero) { EXPECT_FALSE(std::signbit(params_of(message_of(0)).euler.pan)); }

Eigen::Matrix3d axes_of(const std::string& datagram) { return camera::decode_pose(params_of(datagram))->linear(); }

TEST(FreeDDecoder, SignsOfTheAxes) {
  // Columns: the camera's right, forward and up in the studio (x right, y into it, z up).
  const Eigen::Vector3d right(1, 0, 0), into(0, 1, 0), up(0, 0, 1);
  EXPECT_TRUE(axes_of(message_of(0)).isIdentity(1e-12)) << "zero looks along y";
  EXPECT_TRUE(axes_of(message_of(90)).col(1).isApprox(right, 1e-12)) << "pan to the right";
  EXPECT_TRUE(axes_of(message_of(0, 90)).col(1).isApprox(up, 1e-12)) << "tilt up";
  const auto rolled = axes_of(message_of(0, 0, 90));
  EXPECT_TRUE(rolled.col(1).isApprox(into, 1e-12));
  EXPECT_TRUE(rolled.col(2).isApprox(right, 1e-12)) << "clockwise seen from behind: up goes to the right";
}

TEST(FreeDDecoder, APanPast180DegreesIsContinuous) {
  // 170 to 190 degrees in steps of 2, then on as -170, which is 190 again, to -150.
  std::vector<double> pans;
  for (int i = 0; i <= 10; ++i) pans.push_back(170 + 2 * i);
  for (int i = 0; i <= 10; ++i) pans.push_back(-170 + 2 * i);
  for (std::size_t i = 1; i < pans.size(); ++i) {
    const Eigen::AngleAxisd step(axes_of(message_of(pans[i - 1])).transpose() * axes_of(message_of(pans[i])));
    const double expected = i == 11 ? 0 : 2;
    EXPECT_NEAR(step.angle() * 180 / M_PI, expected, 1e-5) << pans[i - 1] << " to " << pans[i];
  }
  EXPECT_EQ(params_of(message_of(190)).euler.pan, -190) << "pan beyond 180 degrees is kept as sent";
}

TEST(FreeDDecoder, FaultsNameTheProblem) {
  const std::string good = test::worked_message();
  EXPECT_THAT(fault_of(""), HasSubstr("wrong size: not the 29 bytes"));
  EXPECT_THAT(fault_of(good.substr(0, 28)), HasSubstr("wrong size"));
  EXPECT_THAT(fault_of(good + '\0'), HasSubstr("wrong size")) << "more than 29 bytes";
  EXPECT_THAT(fault_of("DMC01"), HasSubstr("not Free-D: begins with 44"));
  for (const int type : {0xD0, 0xD2, 0xDB}) {
    std::string other = good;
    other[0] = static_cast<char>(type);
    EXPECT_THAT(fault_of(other), HasSubstr("other Free-D message: Free-D message D")) << type;
  }
  EXPECT_THAT(fault_of("\xDC"), HasSubstr("not Free-D"));
}

TEST(FreeDDecoder, AWrongChecksumIsAFaultOrADoubt) {
  std::string zero = test::worked_message();
  zero.back() = 0;
  EXPECT_THAT(fault_of(zero), HasSubstr("wrong checksum"));
  DecoderOptions options;
  options.lenient = true;
  Decoder decoder(options);
  Sample sample;
  EXPECT_EQ(params_of(decoder, zero, sample), params_of(test::worked_message()));
  EXPECT_STREQ(sample.doubt, "wrong checksum");
  EXPECT_EQ(params_of(decoder, test::worked_message(), sample).counter, 1u) << "the second of this camera";
  EXPECT_STREQ(sample.doubt, "") << "of each message separately";
}

/// The message with these counts and spare bytes.
std::string counts(std::uint32_t zoom, std::uint32_t focus, std::uint16_t spare = 0) {
  Message message;
  message.camera = 3;
  message.zoom = zoom;
  message.focus = focus;
  message.spare = spare;
  const auto all = bytes_of(message);
  return {all.data(), all.size()};
}

Sample sample_of(const std::string& datagram, DecoderOptions options) {
  Decoder decoder(std::move(options));
  Sample sample;
  params_of(decoder, datagram, sample);
  return sample;
}

TEST(FreeDProfile, ZcamSendsItsLens) {
  // The manufacturer's example: 950 is 9.50 mm, 12300 is 1230.0 mm, F2.8 is 280 = 0x118, with the frame number above
  // it.
  const auto sample = sample_of(counts(950, 12300, 0x5118), {Profile::zcam, nullptr, false});
  const auto& p = std::get<wire::CameraParams>(sample.record);
  EXPECT_TRUE(sample.has_lens);
  EXPECT_DOUBLE_EQ(p.fov, 9.5);
  EXPECT_DOUBLE_EQ(p.focdist, 1.23);
  EXPECT_DOUBLE_EQ(p.aperture, 2.8);
  EXPECT_FALSE(sample_of(counts(0, 12300), {Profile::zcam, nullptr, false}).has_lens) << "no focal length";
}

TEST(FreeDProfile, OthersAreCounts) {
  using transport::LensEncoders;
  EXPECT_EQ(sample_of(counts(524288 + 7, 524288 - 9), {Profile::vizrt, nullptr, false}).encoders,
            (LensEncoders{7, -9, {}}));
  EXPECT_EQ(sample_of(counts(5, 6, 0xF123), {Profile::sony, nullptr, false}).encoders, (LensEncoders{5, 6, 0x123}));
  EXPECT_EQ(sample_of(counts(5, 6, 0xF123), {Profile::mosys, nullptr, false}).encoders, (LensEncoders{5, 6, {}}));
}

const char* const table_yaml = R"(
constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}
interpolation: linear
points:
- {zoom: 0, focal_length: 8, center_x: 0.02, k1: -0.001}
- {zoom: 1000, focal_length: 16, center_x: 0.04, k1: 0}
focus:
- {count: 0, distance: 1}
- {count: 100, distance: 2}
)";

TEST(FreeDDecoder, ATableGivesLensAndConstants) {
  Decoder decoder({Profile::generic, table_of(table_yaml), false});
  const std::string datagram = counts(500, 50);
  decoder.begin(datagram, {});
  Sample sample;
  Fault fault;
  ASSERT_EQ(decoder.next(sample, fault), Next::sample);
  const auto* constants = std::get_if<wire::CameraConstants>(&sample.record);
  ASSERT_NE(constants, nullptr) << "before the first parameters of a camera";
  EXPECT_EQ(constants->id, 3u);
  EXPECT_EQ(constants->image_width, 1920);
  EXPECT_EQ(constants->chip_width, 9.6);
  ASSERT_EQ(decoder.next(sample, fault), Next::sample);
  const auto& p = std::get<wire::CameraParams>(sample.record);
  EXPECT_TRUE(sample.has_lens);
  EXPECT_DOUBLE_EQ(p.fov, 12);
  EXPECT_DOUBLE_EQ(p.center_x, 0.03);
  EXPECT_DOUBLE_EQ(p.k1, -0.0005);
  EXPECT_DOUBLE_EQ(p.focdist, 1 / 0.75) << "halfway between 1/m and 0.5/m";
  EXPECT_EQ(sample.encoders.zoom, 500);
  EXPECT_EQ(decoder.next(sample, fault), Next::none);
}

TEST(FreeDDecoder, ConstantsAreRepeatedForEachCamera) {
  Decoder decoder({Profile::generic, table_of(table_yaml), false});
  Sample sample;
  Fault fault;
  int constants = 0, params = 0;
  const std::string datagram = counts(500, 50);
  for (int i = 0; i < 100; ++i) {
    decoder.begin(datagram, {});
    while (decoder.next(sample, fault) == Next::sample) {
      ++(std::holds_alternative<wire::CameraConstants>(sample.record) ? constants : params);
    }
  }
  EXPECT_EQ(params, 100);
  EXPECT_EQ(constants, 2) << "with the 1st and the 51st";
}

TEST(FreeDDecoder, BeyondTheTableThereIsNoLens) {
  const auto beyond = sample_of(counts(1011, 50), {Profile::generic, table_of(table_yaml), false});
  EXPECT_FALSE(beyond.has_lens);
  EXPECT_STREQ(beyond.doubt, "the lens encoders are beyond the lens table");
  const auto at_the_stop = sample_of(counts(1010, 50), {Profile::generic, table_of(table_yaml), false});
  EXPECT_TRUE(at_the_stop.has_lens);
  EXPECT_DOUBLE_EQ(std::get<wire::CameraParams>(at_the_stop.record).fov, 16);
}

}  // namespace trk_bridge::freed::decoder_test
