// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The samples of records, read by other code and by this project's.
#include "opentrackio/encoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <optional>

#include "packets.h"
#include "same_camera.h"
#include "trk_bridge/wire/fields.h"

namespace trk_bridge::opentrackio::encoder_test {

using test::datagrams_of;
using test::given;
using test::Json;
using test::sample_in;
using test::WorkedCase;
using testing::HasSubstr;

constexpr std::int64_t time_of_sample = 1'700'000'000'250'000'001;

WriterSettings from_source(std::uint32_t number, Profile profile = Profile::generic,
                           Model model = Model::distorted_to_undistorted) {
  WriterSettings settings;
  settings.source = number;
  settings.profile = profile;
  settings.model = model;
  return settings;
}

/// The datagrams of a case: constants and parameters.
std::vector<std::string> datagrams_of_case(const WorkedCase& c, const WriterSettings& settings, Encoding encoding) {
  PacketEncoder encoder(settings, encoding, test::source_id);
  encoder.use_time(time_of_sample, {});
  EXPECT_TRUE(datagrams_of(encoder, c.constants).empty()) << "constants go with the next parameters";
  return datagrams_of(encoder, c.params);
}

template <typename Record>
std::string different_bits(const Record& a, const Record& b) {
  std::string names;
  wire::for_each_field<Record>(
      [&](const wire::Field& field, const auto& x, const auto& y) {
        if (std::memcmp(&x, &y, sizeof x) != 0) names += std::string(" ") + field.name;
      },
      a, b);
  return names;
}

std::string different_bits_of(const wire::CameraParams& a, const wire::CameraParams& b) {
  std::string names = different_bits(a, b) + different_bits(a.euler, b.euler);
  if (std::memcmp(a.matrix.data(), b.matrix.data(), sizeof a.matrix) != 0) names += " matrix";
  return names;
}

TEST(OpenTrackIoEncoder, MembersAreThoseOfTheProtocol) {
  WriterSettings settings = from_source(0);
  settings.rate = 59.94;
  PacketEncoder encoder(settings, Encoding::json, test::source_id);
  encoder.use_time(time_of_sample, base::TimeCodeWithRate{{10, 20, 30, 12, 2, true}, 59.94});
  wire::CameraConstants constants;
  constants.id = 7;
  constants.image_width = 1920;
  constants.image_height = 1080;
  constants.blank_left = 10;
  constants.blank_right = 30;
  constants.blank_top = 20;
  constants.chip_width = constants.fake_chip_width = 9.6;
  constants.chip_height = constants.fake_chip_height = 5.4;
  wire::CameraParams params;
  params.id = 7;
  params.format = wire::euler;
  params.euler = {1, 2, 3, 190, -10, 0.5};
  params.fov = 24.5;
  params.center_x = 0.25;
  params.center_y = 0.125;
  params.k1 = 0.001;
  params.k2 = -2e-5;
  params.focdist = 3.5;
  params.counter = 65535;
  ASSERT_TRUE(encoder.begin(constants));
  const Json sample = sample_in(datagrams_of(encoder, params));
  const auto at = [&sample](const char* pointer) { return sample.at(Json::json_pointer(pointer)); };
  EXPECT_EQ(at("/protocol/name"), "OpenTrackIO");
  EXPECT_EQ(at("/protocol/version"), Json({1, 0, 1}));
  EXPECT_EQ(at("/sourceNumber"), 7);
  EXPECT_EQ(at("/sourceId"), test::source_id);
  EXPECT_EQ(at("/timing/sequenceNumber"), 65535);
  EXPECT_EQ(at("/timing/mode"), "internal");
  EXPECT_EQ(at("/timing/sampleTimestamp/seconds"), 1'700'000'037);
  EXPECT_EQ(at("/timing/sampleTimestamp/nanoseconds"), 250'000'001);
  EXPECT_EQ(at("/timing/sampleRate"), Json({{"num", 60000}, {"denom", 1001}}));
  EXPECT_EQ(at("/timing/timecode/frameRate"), Json({{"num", 30000}, {"denom", 1001}}));
  EXPECT_EQ(at("/timing/timecode/frames"), 12);
  EXPECT_EQ(at("/timing/timecode/subFrame"), 1);
  EXPECT_EQ(at("/timing/timecode/dropFrame"), true);
  EXPECT_EQ(at("/lens/pinholeFocalLength"), 24.5);
  EXPECT_EQ(at("/lens/projectionOffset"), Json({{"x", -0.25}, {"y", 0.125}}));
  EXPECT_EQ(at("/lens/distortion"),
            Json::parse(R"([{"model": "Brown-Conrady D-U", "radial": [0.001, 0.0, -2e-5, 0.0, 0.0, 0.0]}])"));
  EXPECT_EQ(at("/lens/focusDistance"), 3.5);
  EXPECT_FALSE(sample.contains(Json::json_pointer("/lens/fStop"))) << "an aperture of 0 is none";
  EXPECT_FALSE(sample.contains(Json::json_pointer("/lens/distortionOffset")));
  EXPECT_EQ(at("/transforms").size(), 1U);
  EXPECT_EQ(at("/transforms/0/translation"), Json({{"x", 1.0}, {"y", 2.0}, {"z", 3.0}}));
  EXPECT_EQ(at("/transforms/0/rotation"), Json({{"pan", 190.0}, {"tilt", -10.0}, {"roll", 0.5}}));
  // Blanks reduce the effective picture; the blanks themselves are in custom, and nothing else is.
  EXPECT_EQ(at("/static/camera/activeSensorResolution"), Json({{"width", 1880}, {"height", 1060}}));
  EXPECT_EQ(at("/static/camera/activeSensorPhysicalDimensions"), Json({{"width", 9.6}, {"height", 5.4}}));
  EXPECT_EQ(at("/custom"), Json::parse(R"({"trk": {"constants": {"image_width": 1920, "image_height": 1080,
            "blank_left": 10, "blank_right": 30, "blank_top": 20}}})"));
}

TEST(OpenTrackIoEncoder, TheStaticPartComesWithConstants) {
  PacketEncoder encoder(from_source(0), Encoding::cbor, test::source_id);
  wire::CameraParams canonical;
  canonical.id = 3;
  canonical.format = wire::euler;
  canonical.fov = 20;
  EXPECT_FALSE(sample_in(datagrams_of(encoder, canonical)).contains("static"));
  wire::CameraConstants constants = test::worked_cases().front().constants;
  constants.id = 3;
  ASSERT_TRUE(encoder.begin(constants));
  EXPECT_FALSE(encoder.next());
  EXPECT_TRUE(sample_in(datagrams_of(encoder, canonical)).contains("static"));
  EXPECT_FALSE(sample_in(datagrams_of(encoder, canonical)).contains("static")) << "once";
}

TEST(OpenTrackIoEncoder, PacketsCountAndFit) {
  PacketEncoder encoder(from_source(1), Encoding::json, test::source_id);
  unsigned sequence = 0;
  std::size_t longest = 0, most = 0;
  for (const WorkedCase& c : test::worked_cases()) {
    ASSERT_TRUE(encoder.begin(c.constants));
    const auto datagrams = datagrams_of(encoder, c.params);
    std::size_t offset = 0;
    for (const auto& datagram : datagrams) {
      const auto packet = opentrackio::packet_of(datagram);
      ASSERT_TRUE(packet);
      EXPECT_EQ(packet->sequence, sequence++);
      EXPECT_EQ(packet->offset, offset);
      EXPECT_EQ(packet->is_last, &datagram == &datagrams.back());
      offset += packet->payload.size();
      longest = std::max(longest, datagram.size());
    }
    most = std::max(most, datagrams.size());
  }
  EXPECT_LE(longest, 1500U - 40 - 8) << "IPv6 and UDP have 40 and 8 bytes";
  EXPECT_GT(most, 1U) << "a case has to need several segments";
}

TEST(OpenTrackIoEncoder, WhatCannotBeSentIsNamed) {
  PacketEncoder encoder(from_source(0), Encoding::json, test::source_id);
  wire::CameraParams params;
  params.format = wire::euler;
  params.fov = 20;
  const auto refusal = [&encoder](const auto& record) {
    const auto begun = encoder.begin(record);
    EXPECT_FALSE(encoder.next());
    return begun ? std::string("no error") : describe(begun.error());
  };
  EXPECT_THAT(refusal(params), HasSubstr("source=N"));
  params.id = 201;
  EXPECT_THAT(refusal(params), HasSubstr("source=N"));
  params.id = 200;
  params.fov = NAN;
  EXPECT_THAT(refusal(params), HasSubstr("finite"));
  params.fov = 20;
  params.format = wire::euler | wire::field_of_view;
  EXPECT_THAT(refusal(params), HasSubstr("constants"));
  EXPECT_NE(refusal(wire::CameraConstants{}), "no error");
}

TEST(OpenTrackIoEncoder, TheSameRecordsToTheLastBit) {
  for (const Encoding encoding : {Encoding::json, Encoding::cbor}) {
    for (const Model model : {Model::distorted_to_undistorted, Model::undistorted_to_distorted}) {
      for (WorkedCase c : test::worked_cases()) {
        // Numbers that exceed a source number or 16 bits, and numbers that need many digits.
        c.params.id = c.constants.id = 4000000000U;
        c.params.counter += 0xFFFFFFFFFF000000U;
        c.params.focdist = std::nextafter(c.params.focdist, 0);
        PacketDecoder decoder(false, 37);
        std::vector<transport::Sample> samples;
        for (const auto& datagram : datagrams_of_case(c, from_source(9, Profile::generic, model), encoding)) {
          const auto all = given(decoder, datagram);
          EXPECT_TRUE(all.faults.empty()) << all.faults.front();
          samples.insert(samples.end(), all.samples.begin(), all.samples.end());
        }
        ASSERT_EQ(samples.size(), 2U);
        EXPECT_EQ(different_bits(std::get<wire::CameraConstants>(samples[0].record), c.constants), "");
        EXPECT_EQ(different_bits_of(std::get<wire::CameraParams>(samples[1].record), c.params), "") << c.mask;
        EXPECT_TRUE(samples[1].has_lens && samples[1].has_counter);
        EXPECT_EQ(samples[1].sample_time, time_of_sample);
      }
    }
  }
}

TEST(OpenTrackIoEncoder, AMatrixThatIsMissingInCustomIsNamed) {
  std::size_t refused = 0;
  for (const WorkedCase& c : test::worked_cases()) {
    if (wire::has(c.params.format, wire::euler)) continue;
    Json sample = sample_in(datagrams_of_case(c, from_source(9), Encoding::cbor));
    ASSERT_EQ(sample.at("custom").at("trk").at("params").erase("matrix"), 1U);
    PacketDecoder decoder(false, 37);
    EXPECT_THAT(given(decoder, test::packet_of(sample.dump())).faults,
                testing::ElementsAre("custom.trk.params.matrix is missing"));
    ++refused;
  }
  EXPECT_GT(refused, 0U);
}

TEST(OpenTrackIoEncoder, TheSameCameraWithoutCustom) {
  for (const WorkedCase& c : test::worked_cases()) {
    Json sample = sample_in(datagrams_of_case(c, from_source(9), Encoding::cbor));
    sample.erase("custom");
    PacketDecoder decoder(false, 37);
    const auto all = given(decoder, test::packet_of(sample.dump()));
    EXPECT_TRUE(all.faults.empty());
    const wire::CameraParams params = all.params();
    EXPECT_EQ(params.id, 9U);
    EXPECT_EQ(params.counter, c.params.counter % 65536);
    const auto camera = camera::decode(params, &all.constants());
    ASSERT_TRUE(camera);
    EXPECT_TRUE(test::same_to_the_digits(*camera, c.camera)) << c.mask;
    EXPECT_EQ(all.constants().image_width, c.constants.image_width - c.constants.blank_left - c.constants.blank_right);
  }
}

/// OpenLensIO's equations for a point in front of the camera, from the standard: mm on the sensor, y down. Independent
/// of the code under test.
struct Receiver {
  double focal_length = 0, width = 0, height = 0;  // mm
  double columns = 0, rows = 0;
  double offset_x = 0, offset_y = 0;  // of projection
  std::string model;
  std::array<double, 6> k{};

  static Receiver of(const Json& sample) {
    const Json& lens = sample["lens"];
    const Json& camera = sample["static"]["camera"];
    Receiver r;
    r.focal_length = lens["pinholeFocalLength"];
    r.offset_x = lens["projectionOffset"]["x"];
    r.offset_y = lens["projectionOffset"]["y"];
    r.model = lens["distortion"][0]["model"];
    for (std::size_t i = 0; i < 6; ++i) r.k[i] = lens["distortion"][0]["radial"][i];
    r.width = camera["activeSensorPhysicalDimensions"]["width"];
    r.height = camera["activeSensorPhysicalDimensions"]["height"];
    r.columns = camera["activeSensorResolution"]["width"];
    r.rows = camera["activeSensorResolution"]["height"];
    return r;
  }

  /// r times the rational polynomial: k1, k3, k5 over k2, k4, k6.
  double mapped(double r) const {
    const double s = r * r;
    return r * (1 + k[0] * s + k[2] * s * s + k[4] * s * s * s) / (1 + k[1] * s + k[3] * s * s + k[5] * s * s * s);
  }
  /// The smallest radius that is mapped to it, by steps and bisection.
  double unmapped(double wanted) const {
    double low = 0, high = 0;
    const double step = wanted / 1000;
    while (mapped(high) < wanted && high < 3 * wanted) high = (low = high) + step;
    for (int i = 0; i < 200; ++i) {
      const double middle = (low + high) / 2;
      (mapped(middle) < wanted ? low : high) = middle;
    }
    return low;
  }

  /// Columns and rows from the corner of the effective picture.
  Eigen::Vector2d picture(const Eigen::Vector3d& point) const {
    const double x = focal_length * point.x() / point.y(), y = -focal_length * point.z() / point.y();
    const double undistorted = std::hypot(x, y);
    const double distorted = model == "Brown-Conrady D-U" ? unmapped(undistorted) : mapped(undistorted);
    const double factor = undistorted > 0 ? distorted / undistorted : 1;
    return {((x * factor + offset_x) / width + 0.5) * columns, ((y * factor + offset_y) / height + 0.5) * rows};
  }
};

/// In the coordinates of the cases: of the whole image, from the middle of its first pixel.
Eigen::Vector2d ros_pixel(const Eigen::Vector2d& picture, const wire::CameraConstants& constants) {
  return picture + Eigen::Vector2d(constants.blank_left - 0.5, constants.blank_top - 0.5);
}

bool is_in_image(const Eigen::Vector2d& pixel, const wire::CameraConstants& constants) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= constants.image_width - 1 &&
         pixel.y() <= constants.image_height - 1;
}

TEST(OpenTrackIoEncoder, ThePixelsOfTheWorkedCasesByTheEquationsOfTheStandard) {
  for (const Model model : {Model::distorted_to_undistorted, Model::undistorted_to_distorted}) {
    // From undistorted to distorted it is a fit, over the image.
    const bool is_fitted = model == Model::undistorted_to_distorted;
    int points = 0;
    double worst = 0;
    for (const WorkedCase& c : test::worked_cases()) {
      const Json sample = sample_in(datagrams_of_case(c, from_source(9, Profile::generic, model), Encoding::json));
      const Receiver receiver = Receiver::of(sample);
      EXPECT_EQ(receiver.model, is_fitted ? "Brown-Conrady U-D" : "Brown-Conrady D-U");
      for (const test::Point& point : c.points) {
        if (is_fitted && !is_in_image(point.distorted, c.constants)) continue;
        const Eigen::Vector2d pixel = ros_pixel(receiver.picture(point.camera), c.constants);
        worst = std::max(worst, (pixel - point.distorted).norm());
        ++points;
      }
    }
    EXPECT_GT(points, 1000);
    EXPECT_LT(worst, is_fitted ? 0.02 : 1e-6);
  }
}

/// What is known about Unreal's reader: the principal point is distortionOffset; fewer than six radial values are
/// ignored; there is no distortion without the sensor's size and the focal length; single precision, in units of the
/// sensor.
std::optional<Eigen::Vector2d> unreal_picture(const Json& sample, const Eigen::Vector3d& point) {
  const Json& lens = sample.at("lens");
  const Json& camera = sample.at("static").at("camera");
  for (const char* name : {"make", "model", "serialNumber", "label"}) {
    if (!camera.contains(name) || camera[name].get<std::string>().empty()) return std::nullopt;
  }
  const auto number = [](const Json& value) { return static_cast<double>(static_cast<float>(value.get<double>())); };
  const double f = number(lens.at("pinholeFocalLength"));
  const double w = number(camera.at("activeSensorPhysicalDimensions").at("width"));
  const double h = number(camera.at("activeSensorPhysicalDimensions").at("height"));
  double cx = 0.5, cy = 0.5;
  if (lens.contains("distortionOffset")) {
    cx += number(lens["distortionOffset"]["x"]) / w;
    cy += number(lens["distortionOffset"]["y"]) / h;
  }
  std::array<double, 6> k{};
  const Json& radial = lens.at("distortion").at(0).at("radial");
  if (radial.size() >= 6) {
    // k1 to k6 in turns of numerator and denominator, of mm; here of focal lengths.
    for (std::size_t i = 0; i < 6; ++i) {
      k[i] = static_cast<float>(number(radial[i]) * std::pow(f, 2.0 * static_cast<double>(i / 2 + 1)));
    }
  }
  Receiver polynomial;
  polynomial.k = k;
  const double x = point.x() / point.y(), y = -point.z() / point.y();
  const double r = std::hypot(x, y);
  const double factor = r > 0 ? polynomial.unmapped(r) / r : 1;
  return Eigen::Vector2d((cx + x * factor * f / w) * camera["activeSensorResolution"]["width"].get<double>(),
                         (cy + y * factor * f / h) * camera["activeSensorResolution"]["height"].get<double>());
}

TEST(OpenTrackIoEncoder, ThePixelsOfTheWorkedCasesByUnrealsReader) {
  int points = 0;
  double worst = 0, worst_generic = 0;
  for (const WorkedCase& c : test::worked_cases()) {
    const Json unreal = sample_in(datagrams_of_case(c, from_source(9, Profile::unreal), Encoding::json));
    const Json generic = sample_in(datagrams_of_case(c, from_source(9), Encoding::json));
    for (const test::Point& point : c.points) {
      if (!is_in_image(point.distorted, c.constants)) continue;
      const auto picture = unreal_picture(unreal, point.camera);
      ASSERT_TRUE(picture);
      worst = std::max(worst, (ros_pixel(*picture, c.constants) - point.distorted).norm());
      worst_generic = std::max(
          worst_generic, (ros_pixel(*unreal_picture(generic, point.camera), c.constants) - point.distorted).norm());
      ++points;
    }
  }
  EXPECT_GT(points, 1000);
  EXPECT_LT(worst, 0.1);
  EXPECT_GT(worst_generic, 1.0) << "the profile is of no use";
}

}  // namespace trk_bridge::opentrackio::encoder_test
