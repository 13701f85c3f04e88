// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The results of packets and samples.
#include "opentrackio/decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "exact_copy.h"
#include "packets.h"

namespace trk_bridge::opentrackio::decoder_test {

using test::full_sample;
using test::given;
using test::Given;
using test::Json;
using test::packet_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Given given_of(const Json& sample, Encoding encoding = Encoding::json) {
  PacketDecoder decoder(false, 37);
  if (encoding == Encoding::json) return given(decoder, packet_of(sample.dump()));
  std::vector<std::uint8_t> bytes = Json::to_cbor(sample);
  return given(decoder, packet_of(std::string(bytes.begin(), bytes.end()), encoding));
}

Json with(Json sample, const char* pointer, const Json& value) {
  sample[Json::json_pointer(pointer)] = value;
  return sample;
}

Json without(Json sample, const char* pointer, const char* name) {
  sample[Json::json_pointer(pointer)].erase(name);
  return sample;
}

std::string fault_of(const Json& sample) {
  const Given all = given_of(sample);
  return all.faults.empty() ? "" : all.faults.front();
}

TEST(OpenTrackIoDecoder, ACompleteSampleInBothEncodings) {
  for (const Encoding encoding : {Encoding::json, Encoding::cbor}) {
    const Given all = given_of(full_sample(), encoding);
    ASSERT_THAT(all.faults, IsEmpty());
    ASSERT_THAT(all.samples, SizeIs(2));
    wire::CameraConstants constants;
    constants.id = 7;
    constants.image_width = 1920;
    constants.image_height = 1080;
    constants.chip_width = constants.fake_chip_width = 9.6;
    constants.chip_height = constants.fake_chip_height = 5.4;
    EXPECT_EQ(std::get<wire::CameraConstants>(all.samples[0].record), constants);

    wire::CameraParams params;
    params.id = 7;
    params.format = wire::euler;
    params.euler = {1, 2.5, -3, 190, -10, 0.5};
    params.fov = 24.5;
    params.center_x = -0.25;
    params.center_y = -0.125;
    params.k1 = 0.001;
    params.k2 = -0.00002;
    params.focdist = 3.5;
    params.aperture = 2.8;
    params.counter = 65535;
    const transport::Sample& sample = all.samples[1];
    EXPECT_EQ(std::get<wire::CameraParams>(sample.record), params);
    EXPECT_TRUE(sample.has_counter && sample.has_lens);
    EXPECT_EQ(sample.sample_time, 1'700'000'000'250'000'000) << "37 s behind TAI";
    ASSERT_TRUE(sample.time_code);
    EXPECT_EQ(base::to_string(sample.time_code->code), "10:20:30:12:2");
    EXPECT_EQ(sample.time_code->rate, 50);
    EXPECT_STREQ(sample.origin, encoding == Encoding::json ? "OpenTrackIO JSON" : "OpenTrackIO CBOR");
  }
}

TEST(OpenTrackIoDecoder, MissingPartsAreReported) {
  const Json sample = full_sample();
  const Given no_lens = given_of(without(sample, "", "lens"));
  EXPECT_FALSE(no_lens.samples.at(1).has_lens);
  EXPECT_FALSE(given_of(without(sample, "/timing", "sequenceNumber")).samples.at(1).has_counter);
  EXPECT_FALSE(given_of(without(sample, "/timing", "sampleTimestamp")).samples.at(1).sample_time);
  EXPECT_FALSE(given_of(without(sample, "/timing", "timecode")).samples.at(1).time_code);
  EXPECT_THAT(given_of(without(sample, "", "static")).samples, SizeIs(1));
  EXPECT_THAT(given_of(without(sample, "", "transforms")).samples, SizeIs(1)) << "constants alone";
  EXPECT_THAT(fault_of(without(without(sample, "", "static"), "", "transforms")), HasSubstr("neither transforms"));
  const Given no_pixels = given_of(without(sample, "/static/camera", "activeSensorResolution"));
  ASSERT_THAT(no_pixels.samples, SizeIs(1));
  EXPECT_THAT(no_pixels.samples[0].origin, HasSubstr("no activeSensorResolution"));
}

TEST(OpenTrackIoDecoder, OmittedPartsAreReported) {
  const Json sample = full_sample();
  EXPECT_THAT(given_of(with(sample, "/lens/distortion/0/tangential", {0.0, 1e-4})).samples.at(1).origin,
              HasSubstr("tangential"));
  EXPECT_STREQ(given_of(with(sample, "/lens/distortion/0/tangential", {0.0, 0.0})).samples.at(1).origin,
               "OpenTrackIO JSON");
  EXPECT_THAT(given_of(with(sample, "/transforms/0/scale", {{"x", 1}, {"y", 2}, {"z", 1}})).samples.at(1).origin,
              HasSubstr("scale"));
  const Json other = with(sample, "/lens/distortionOffset", {{"x", 0.5}, {"y", 0.0}});
  EXPECT_THAT(given_of(other).samples.at(1).origin, HasSubstr("distortionOffset"));
  const Json alone = without(other, "/lens", "projectionOffset");
  EXPECT_EQ(given_of(alone).params().center_x, -0.5) << "Unreal's place for the principal point";
}

TEST(OpenTrackIoDecoder, TransformsAreMultipliedInOrder) {
  // The base turns left by 90 degrees, so that the arm's forward is -x; the arm ends 2 m before it, 1 m up, and the
  // head turns back by 30.
  const Json sample = with(full_sample(), "/transforms", Json::parse(R"([
    {"id": "Base", "translation": {"x": 1, "y": 2, "z": 3}, "rotation": {"pan": 90, "tilt": 0, "roll": 0}},
    {"id": "Arm", "translation": {"x": 0, "y": 2, "z": 1}, "rotation": {}},
    {"id": "Camera", "translation": {"y": 0.5}, "rotation": {"pan": -30, "tilt": 10}}])"));
  const wire::Euler euler = given_of(sample).params().euler;
  EXPECT_NEAR(euler.x, -1.5, 1e-12);
  EXPECT_NEAR(euler.y, 2, 1e-12);
  EXPECT_NEAR(euler.z, 4, 1e-12);
  EXPECT_NEAR(euler.pan, 60, 1e-12);
  EXPECT_NEAR(euler.tilt, 10, 1e-12);
  EXPECT_NEAR(euler.roll, 0, 1e-12);
}

TEST(OpenTrackIoDecoder, TimeCodesOfAllRates) {
  const auto code_of = [](int frames, int num, int denom, std::optional<int> sub_frame, bool drop = false) {
    Json code = {{"hours", 1}, {"minutes", 2}, {"seconds", 3}, {"frames", frames}};
    code["frameRate"] = {{"num", num}, {"denom", denom}};
    if (sub_frame) code["subFrame"] = *sub_frame;
    if (drop) code["dropFrame"] = true;
    const auto counted = given_of(with(full_sample(), "/timing/timecode", code)).samples.at(1).time_code;
    return base::to_string(counted->code) + " at " + std::to_string(counted->rate);
  };
  EXPECT_EQ(code_of(23, 24, 1, {}), "01:02:03:23:1 at 24.000000");
  EXPECT_EQ(code_of(24, 25, 1, 1), "01:02:03:24:2 at 50.000000");
  EXPECT_EQ(code_of(49, 50, 1, {}), "01:02:03:24:2 at 50.000000") << "trk counts two fields a frame";
  EXPECT_EQ(code_of(29, 30000, 1001, 0, true), "01:02:03;29:1 at 59.940060");
}

TEST(OpenTrackIoDecoder, InvalidSourceNumbersAreRefused) {
  const std::string rule = "sourceNumber is missing or not 1 to 200";
  for (const Json& number : {Json(0), Json(201), Json(255), Json(70000)}) {
    EXPECT_THAT(fault_of(with(full_sample(), "/sourceNumber", number)), HasSubstr(rule));
    PacketDecoder any(true, 37);
    EXPECT_EQ(given(any, packet_of(with(full_sample(), "/sourceNumber", number).dump())).params().id,
              number.get<std::uint32_t>());
  }
  EXPECT_THAT(fault_of(without(full_sample(), "", "sourceNumber")), HasSubstr(rule));
  for (const int number : {1, 200}) EXPECT_EQ(fault_of(with(full_sample(), "/sourceNumber", number)), "");
}

TEST(OpenTrackIoDecoder, UnknownMembersAreIgnored) {
  Json sample = full_sample();
  sample["custom"] = {{"pot1", 2435}, {"deep", {{"er", {1, {{"x", nullptr}}, "text"}}}}};
  sample["lens"]["encoders"] = {{"focus", 0.1}};
  sample["lens"]["distortion"].push_back({{"model", "another"}, {"radial", {5, 5, 5}}});
  sample["transforms"][0]["id"] = "Camera";
  sample["tracker"] = {{"recording", false}, {"notes", nullptr}};
  sample["x"] = "not a transform's";
  for (const Encoding encoding : {Encoding::json, Encoding::cbor}) {
    const Given all = given_of(sample, encoding);
    EXPECT_THAT(all.faults, IsEmpty());
    EXPECT_EQ(all.params(), given_of(full_sample()).params());
  }
}

TEST(OpenTrackIoDecoder, WrongTypesNameTheMember) {
  const Json sample = full_sample();
  EXPECT_EQ(fault_of(with(sample, "/lens/pinholeFocalLength", "24")), "lens.pinholeFocalLength is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/lens/fStop", nullptr)), "lens.fStop is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/lens/fStop", {1})), "lens.fStop is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/lens", 5)), "lens is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/transforms", Json::object())), "transforms is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/transforms/0", 5)), "transforms is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/transforms/0/rotation/pan", true)), "transforms.rotation.pan is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/lens/distortion/0/radial/2", "x")), "lens.distortion.radial is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/lens/distortion/0/radial/2", Json::array())),
            "lens.distortion.radial is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/lens/distortion/0/model", 1)), "lens.distortion.model is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/timing/sequenceNumber", 1.5)), "timing.sequenceNumber is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/timing/sequenceNumber", -1)), "timing.sequenceNumber is out of range");
  EXPECT_EQ(fault_of(with(sample, "/timing/timecode/minutes", 60)), "timing.timecode.minutes is out of range");
  EXPECT_EQ(fault_of(with(sample, "/lens/pinholeFocalLength", -1)), "lens.pinholeFocalLength is out of range");
  EXPECT_EQ(fault_of(Json::array({1})), "the sample is of the wrong type");
  EXPECT_EQ(fault_of(Json(1)), "the sample is of the wrong type");
  EXPECT_EQ(fault_of(with(sample, "/timing/sequenceNumber", 12.0)), "") << "a whole number all the same";
}

TEST(OpenTrackIoDecoder, PayloadsOfAnotherEncoding) {
  PacketDecoder decoder(false, 37);
  const std::string text = full_sample().dump();
  EXPECT_THAT(given(decoder, packet_of(text.substr(0, 100))).faults, ElementsAre(HasSubstr("not JSON")));
  EXPECT_THAT(given(decoder, packet_of(text + "}")).faults, ElementsAre(HasSubstr("not JSON")));
  EXPECT_THAT(given(decoder, packet_of("")).faults, ElementsAre(HasSubstr("not JSON")));
  EXPECT_THAT(given(decoder, packet_of(text, Encoding::cbor)).faults, ElementsAre(HasSubstr("not CBOR")));
  // 1e999 is out of range of a double, and CBOR has NaN and infinity.
  EXPECT_THAT(given(decoder, packet_of(R"({"lens": {"fStop": 1e999}})")).faults, SizeIs(1));
  const std::string nan(
      "\xA1\x64lens\xA1\x65"
      "fStop\xF9\x7E\x00",
      16);
  EXPECT_THAT(given(decoder, packet_of(nan, Encoding::cbor)).faults, ElementsAre("lens.fStop is out of range"));
  EXPECT_THAT(given(decoder, packet_of(std::string(3000, '['))).faults, SizeIs(1));
  EXPECT_THAT(given(decoder, packet_of("{\"a\":" + std::string(1000, '[') + std::string(1000, ']') + "}")).faults,
              ElementsAre(HasSubstr("deeper")));
  EXPECT_THAT(given(decoder, packet_of("\xA1\x61"
                                       "a" +
                                           std::string(3000, '\x81'),
                                       Encoding::cbor))
                  .faults,
              ElementsAre(HasSubstr("deeper")));
}

TEST(OpenTrackIoDecoder, Headers) {
  // Of "{}": 4F 54 72 6B 00 01 00 05 00000000 8002, 7B 7D. The sums of these 16 bytes, modulo 256, by hand:
  // 4F A3 15 80 80 81 81 86 86 86 86 86 06 08 | 83 00; and the sums of the sums: 4F F2 07 87 07 88 09 8F 15 9B 21 A7 AD
  // B5 | 38 38.
  const std::string bytes("OTrk\0\x01\0\x05\0\0\0\0\x80\x02\x38\0{}", 18);
  EXPECT_EQ(packet_of("{}", Encoding::json, 5), bytes);
  const auto packet = opentrackio::packet_of(bytes);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->sequence, 5);
  EXPECT_EQ(packet->payload, "{}");
  PacketBuffer buffer;
  EXPECT_EQ(write(*packet, buffer), bytes);

  PacketDecoder decoder(false, 37);
  const auto fault_with = [&](std::size_t at, char value) {
    std::string changed = bytes;
    changed[at] = value;
    const auto all = given(decoder, changed);
    return all.faults.empty() ? "" : all.faults.front();
  };
  EXPECT_THAT(fault_with(0, 'o'), HasSubstr("OTrk"));
  for (const std::size_t at : {4U, 5U, 6U, 7U, 8U, 9U, 10U, 11U, 14U, 15U, 16U, 17U}) {
    EXPECT_EQ(fault_with(at, 'x'), "wrong checksum") << at;
  }
  EXPECT_THAT(fault_with(13, 3), HasSubstr("as long as"));
  EXPECT_THAT(given(decoder, bytes + "x").faults, ElementsAre(HasSubstr("as long as")));
  EXPECT_THAT(given(decoder, bytes.substr(0, 15)).faults, ElementsAre(HasSubstr("16 bytes")));
  EXPECT_THAT(given(decoder, "").faults, ElementsAre(HasSubstr("16 bytes")));
  EXPECT_THAT(given(decoder, packet_of("{}", static_cast<Encoding>(3))).faults, ElementsAre(HasSubstr("JSON")));
}

/// The sample with this counter in three segments.
std::vector<std::string> segments(int counter, unsigned sequence) {
  const std::string text = with(full_sample(), "/timing/sequenceNumber", counter).dump();
  return {packet_of(text.substr(0, 100), Encoding::json, sequence & 0xFFFFU, 0, false),
          packet_of(text.substr(100, 250), Encoding::json, (sequence + 1) & 0xFFFFU, 100, false),
          packet_of(text.substr(350), Encoding::json, (sequence + 2) & 0xFFFFU, 350, true)};
}

TEST(OpenTrackIoDecoder, SegmentsAreOneSample) {
  PacketDecoder decoder(false, 37);
  for (const unsigned sequence : {10U, 0xFFFFU}) {  // the second wraps within the sample
    const auto parts = segments(5, sequence);
    EXPECT_THAT(given(decoder, parts[0]).samples, IsEmpty());
    EXPECT_THAT(given(decoder, parts[1]).samples, IsEmpty());
    EXPECT_THAT(given(decoder, parts[1]).faults, IsEmpty()) << "a duplicate is ignored";
    const Given all = given(decoder, parts[2]);
    EXPECT_THAT(all.faults, IsEmpty());
    EXPECT_EQ(all.params().counter, 5U);
    EXPECT_EQ(all.constants().image_width, 1920);
  }
}

TEST(OpenTrackIoDecoder, SegmentsOfTwoSendersDoNotMix) {
  PacketDecoder decoder(false, 37);
  const auto one = segments(5, 0xFFFF), other = segments(6, 10);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_THAT(given(decoder, one[i], 1).samples, IsEmpty());
    EXPECT_THAT(given(decoder, other[i], 2).samples, IsEmpty());
  }
  EXPECT_EQ(given(decoder, one[2], 1).params().counter, 5U);
  EXPECT_EQ(given(decoder, other[2], 2).params().counter, 6U);
}

TEST(OpenTrackIoDecoder, AnIncompleteSampleIsDiscarded) {
  for (std::size_t missing = 0; missing < 3; ++missing) {
    PacketDecoder decoder(false, 37);
    std::vector<std::string> faults;
    std::vector<std::uint64_t> counters;
    for (int sample = 0; sample < 3; ++sample) {
      const auto parts = segments(sample, 3U * static_cast<unsigned>(sample));
      for (std::size_t i = 0; i < 3; ++i) {
        if (sample == 1 && i == missing) continue;
        const Given all = given(decoder, parts[i]);
        faults.insert(faults.end(), all.faults.begin(), all.faults.end());
        if (!all.samples.empty()) counters.push_back(all.params().counter);
      }
    }
    EXPECT_THAT(counters, ElementsAre(0U, 2U)) << missing;
    EXPECT_THAT(faults, ElementsAre(HasSubstr("a segment is missing"))) << missing << ": reported once";
  }
}

TEST(OpenTrackIoDecoder, ASampleIsNotLongerThanAllowed) {
  PacketDecoder decoder(false, 37);
  const std::string part(4000, ' ');
  std::vector<std::string> faults;
  for (unsigned i = 0; i < 20; ++i) {
    const Given all = given(decoder, packet_of(part, Encoding::json, i, i * 4000, false));
    faults.insert(faults.end(), all.faults.begin(), all.faults.end());
  }
  EXPECT_THAT(faults, ElementsAre(HasSubstr("65536 bytes")));
  EXPECT_EQ(given(decoder, packet_of(full_sample().dump())).params().counter, 65535U);
}

TEST(OpenTrackIoDecoder, ADuplicateMessageIsCountedOnce) {
  PacketDecoder decoder(false, 37);
  const std::string packet = packet_of(full_sample().dump(), Encoding::json, 9);
  EXPECT_THAT(given(decoder, packet, 1).samples, SizeIs(2));
  const Given again = given(decoder, packet, 2);
  EXPECT_THAT(again.samples, IsEmpty());
  EXPECT_THAT(again.faults, IsEmpty());
  EXPECT_THAT(given(decoder, packet_of(full_sample().dump(), Encoding::json, 10)).samples, SizeIs(2));
}

TEST(OpenTrackIoDecoder, ASenderThatDoesNotCountIsAccepted) {
  PacketDecoder decoder(false, 37);
  const std::string packet = packet_of(full_sample().dump());
  int received = 0;
  for (int i = 0; i < 100; ++i) received += given(decoder, packet).samples.empty() ? 0 : 1;
  EXPECT_GE(received, 90);
}

TEST(OpenTrackIoDecoder, DistortionThatHasToBeFitted) {
  // u = 1 + 1e-3 r^2 over 1 + 2e-4 r^2, about 1 + 8e-4 r^2 - 1.6e-7 r^4 (r up to 5.5 mm). Divided out: k1 = 1e-3 -
  // 2e-4, k2 = -2e-4 * 8e-4.
  Json sample = with(full_sample(), "/lens/distortion/0", {{"radial", {1e-3, 2e-4, 0, 0, 0, 0}}});
  const wire::CameraParams params = given_of(sample).params();
  EXPECT_NEAR(params.k1, 8e-4, 1e-6);
  EXPECT_NEAR(params.k2, -1.6e-7, 3e-8);
  // The rest of a series that ends there is 1e-3 mm at the corner at most; the fit is better.
  for (const double r : {1.0, 3.0, 5.5}) {
    const double wanted = (1 + 1e-3 * r * r) / (1 + 2e-4 * r * r);
    EXPECT_NEAR(1 + params.k1 * r * r + params.k2 * r * r * r * r, wanted, 2e-6) << r;
  }
  const Given early = given_of(without(sample, "", "static"));
  EXPECT_FALSE(early.samples.at(0).has_lens);
  EXPECT_THAT(early.faults, ElementsAre(HasSubstr("sensor")));
  sample["lens"]["distortion"][0]["radial"] = {-0.5, 0, 0.001, 0.0, 0.0, 1e-9};
  EXPECT_THAT(fault_of(sample), HasSubstr("folds"));
  EXPECT_FALSE(given_of(sample).samples.at(1).has_lens);
  sample["lens"]["distortion"][0]["model"] = "Fisheye";
  EXPECT_THAT(fault_of(sample), HasSubstr("neither \"Brown-Conrady D-U\""));
}

TEST(OpenTrackIoDecoder, TenThousandMutatedPackets) {
  std::mt19937 random(13);
  const auto up_to = [&random](std::size_t most) {
    return std::uniform_int_distribution<std::size_t>(0, most)(random);
  };
  const std::string json = full_sample().dump();
  const std::vector<std::uint8_t> cbor_bytes = Json::to_cbor(full_sample());
  const std::string cbor(cbor_bytes.begin(), cbor_bytes.end());
  PacketDecoder decoder(false, 37);
  int valid = 0, invalid = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Encoding encoding = i % 2 == 0 ? Encoding::json : Encoding::cbor;
    std::string bytes = encoding == Encoding::json ? json : cbor;
    const bool with_header = i % 3 == 0;
    if (with_header) bytes = packet_of(bytes, encoding, static_cast<unsigned>(i));
    for (std::size_t change = up_to(3); change != SIZE_MAX; --change) {
      const std::size_t at = up_to(bytes.size() - 1);
      switch (up_to(3)) {
        case 0:
          bytes[at] = static_cast<char>(up_to(255));
          break;
        case 1:
          bytes.erase(at, up_to(8));
          break;
        case 2:
          bytes.insert(at, bytes.substr(up_to(bytes.size() - 1), up_to(20)));
          break;
        default:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << up_to(7)));
      }
      if (bytes.empty()) bytes = "x";
    }
    // With a valid header, the changed bytes reach the parser of the sample.
    if (!with_header) bytes = packet_of(bytes.substr(0, 3000), encoding, static_cast<unsigned>(i));
    const test::ExactCopy exact(bytes);
    const Given all = given(decoder, exact.view());
    invalid += static_cast<int>(all.faults.size());
    for (const auto& sample : all.samples) {
      const auto* params = std::get_if<wire::CameraParams>(&sample.record);
      if (params == nullptr) continue;
      ++valid;
      wire::for_each_euler_field([](const wire::Field& f, double v) { EXPECT_TRUE(std::isfinite(v)) << f.name; },
                                 params->euler);
      wire::for_each_lens_field([](const wire::Field& f, double v) { EXPECT_TRUE(std::isfinite(v)) << f.name; },
                                *params);
    }
  }
  EXPECT_GT(valid, 500) << "digits and names that changed";
  EXPECT_GT(invalid, 3000);
  EXPECT_EQ(given(decoder, packet_of(json, Encoding::json, 54321)).params(), given_of(full_sample()).params());
}

/// The reference samples of SMPTE RIS OSVP are not in this repository: a variable of the build names their folder.
TEST(OpenTrackIoDecoder, ReferenceSamples) {
  const std::filesystem::path folder(TRK_BRIDGE_OPENTRACKIO_VECTORS);
  if (folder.empty()) GTEST_SKIP() << "TRK_BRIDGE_OPENTRACKIO_VECTORS is not set";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().string().find("_example.json") == std::string::npos) continue;
    std::ifstream in(entry.path());
    const Json sample = Json::parse(in);
    for (const Encoding encoding : {Encoding::json, Encoding::cbor}) {
      const Given all = given_of(sample, encoding);
      const wire::CameraParams& params = all.params();
      EXPECT_EQ(params.id, 1U);
      EXPECT_EQ(params.fov, 24.305);
      EXPECT_EQ(params.focdist, 10);
      EXPECT_EQ(params.aperture, 4);
      EXPECT_EQ(params.center_x, -0.1);
      EXPECT_EQ(params.center_y, 0.2);
      ASSERT_TRUE(all.samples.back().time_code);
      EXPECT_EQ(base::to_string(all.samples.back().time_code->code), "01:02:03:04:1");
      if (sample["transforms"].size() == 1) {
        EXPECT_EQ(params.euler.pan, 180);
        EXPECT_EQ(params.euler.tilt, 90);
        EXPECT_EQ(params.euler.roll, 45);
        EXPECT_EQ(params.euler.z, 3);
      }
      // The only one with all values of the sensor.
      if (sample.contains("static") && sample["static"]["camera"].contains("activeSensorResolution")) {
        EXPECT_EQ(all.constants().image_width, 3840);
        EXPECT_EQ(all.constants().chip_height, 24);
      }
    }
    ++count;
  }
  EXPECT_EQ(count, 4);
}

}  // namespace trk_bridge::opentrackio::decoder_test
