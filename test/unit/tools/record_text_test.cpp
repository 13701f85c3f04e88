// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tools/record_text.h"

#include <cstring>
#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::tools::record_text_test {

using testing::HasSubstr;

std::uint64_t bits(double value) {
  std::uint64_t result = 0;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

transport::Sample sample_of(const wire::Record& record) {
  transport::Sample sample;
  sample.record = record;
  sample.arrival = 1'700'000'000'123'456'789;
  sample.sender = {transport::SenderKind::ipv4, {192, 0, 2, 7}, 50123};
  return sample;
}

rapidjson::Document parsed(std::string_view text) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(text.data(), text.size());
  EXPECT_FALSE(document.HasParseError()) << text;
  return document;
}

TEST(JsonLine, AnyDoubleRoundTripsExactly) {
  std::mt19937_64 random(20240229);
  JsonLine line;
  for (int i = 0; i < 20'000; ++i) {
    wire::CameraParams params;
    params.format = wire::euler;
    const std::uint64_t pattern = random();
    std::memcpy(&params.fov, &pattern, sizeof pattern);
    if (!std::isfinite(params.fov)) continue;
    const auto json = parsed(line.of(sample_of(params)));
    ASSERT_EQ(bits(json["fov"].GetDouble()), bits(params.fov)) << line.of(sample_of(params));
  }
}

TEST(JsonLine, DifficultDoublesAreExact) {
  JsonLine line;
  for (const double value :
       {-0.0, 0.0, 1e22, 5e-324, std::numeric_limits<double>::max(), 0.1, 1.0 / 3.0, 179.99999, -7.0}) {
    wire::CameraConstants constants;
    constants.chip_width = value;
    EXPECT_EQ(bits(parsed(line.of(sample_of(constants)))["chipWidth"].GetDouble()), bits(value)) << value;
  }
}

TEST(JsonLine, HasTheDocumentsNamesForConstants) {
  const auto cases = test::read_jsonl("field/identified_lp64/constants.jsonl");
  JsonLine line;
  for (const auto& one : cases) {
    const wire::CameraConstants constants = test::constants_of(one["fields"]);
    const auto json = parsed(line.of(sample_of(constants)));
    EXPECT_STREQ(json["type"].GetString(), "constants");
    EXPECT_STREQ(json["sender"].GetString(), "192.0.2.7:50123");
    EXPECT_EQ(test::constants_of(json), constants);
    EXPECT_EQ(json.MemberCount(), 14u);
  }
}

TEST(JsonLine, HasTheExactArrival) {
  JsonLine line;
  EXPECT_THAT(std::string(line.of(sample_of(wire::CameraParams{}))), HasSubstr("\"arrival\":1700000000.123456789,"));
}

TEST(JsonLine, HasTheTimeCodeIfThereIsOne) {
  JsonLine line;
  auto sample = sample_of(wire::CameraParams{});
  EXPECT_FALSE(parsed(line.of(sample)).HasMember("time_code"));
  sample.time_code = base::TimeCodeWithRate{{10, 20, 30, 12, 1, true}, 59.94};
  EXPECT_STREQ(parsed(line.of(sample))["time_code"].GetString(), "10:20:30;12:1");
  EXPECT_THAT(plain_line(sample), HasSubstr(" 10:20:30;12:1 id "));
}

TEST(JsonLine, ValuesThatAreNotFiniteAreNull) {
  wire::CameraParams params;
  params.k1 = std::numeric_limits<double>::infinity();
  JsonLine line;
  EXPECT_TRUE(parsed(line.of(sample_of(params)))["k1"].IsNull());
}

TEST(JsonLine, LargeCountersAreExact) {
  wire::CameraParams params;
  params.counter = std::numeric_limits<std::uint64_t>::max();
  params.id = std::numeric_limits<std::uint32_t>::max();
  JsonLine line;
  const auto json = parsed(line.of(sample_of(params)));
  EXPECT_EQ(json["counter"].GetUint64(), params.counter);
  EXPECT_EQ(json["id"].GetUint(), params.id);
}

TEST(RecordText, WithoutALensThereAreCountsAndDoubts) {
  wire::CameraParams params;
  params.format = wire::euler;
  auto sample = sample_of(params);
  sample.has_lens = false;
  sample.encoders = {74565, {}, -3};
  sample.doubt = "wrong checksum";
  JsonLine line;
  const auto json = parsed(line.of(sample));
  EXPECT_FALSE(json.HasMember("fov") || json.HasMember("k1") || json.HasMember("focus_encoder"));
  EXPECT_EQ(json["zoom_encoder"].GetInt(), 74565);
  EXPECT_EQ(json["iris_encoder"].GetInt(), -3);
  EXPECT_STREQ(json["doubt"].GetString(), "wrong checksum");
  EXPECT_THAT(plain_line(sample),
              testing::EndsWith("roll 0 0 0 deg zoom_encoder 74565 iris_encoder -3 no lens (wrong checksum)"));
}

TEST(PlainLine, NamesTheUnitsOfTheFormat) {
  wire::CameraParams params;
  params.id = 7;
  params.counter = 1234;
  params.format = wire::euler | wire::field_of_view | wire::shift_in_pixels | 0x400;
  params.euler = {1.5, -2, 1.75, 30, -5, 0};
  params.fov = 42;
  params.center_x = 0.25;
  const std::string line = plain_line(sample_of(params));
  EXPECT_THAT(line, testing::StartsWith("2023-11-14T22:13:20.123456789Z 192.0.2.7:50123 id 7 params 1234 [euler "));
  EXPECT_THAT(line, HasSubstr("1.5 -2 1.75 m pan tilt roll 30 -5 0 deg field of view 42 deg center 0.25 0 px"));
  EXPECT_THAT(line, HasSubstr("unknown format bits 0x400"));
  params.format = 0;
  EXPECT_THAT(plain_line(sample_of(params)), HasSubstr("image distance 42 mm center 0.25 0 mm"));
}

}  // namespace trk_bridge::tools::record_text_test
