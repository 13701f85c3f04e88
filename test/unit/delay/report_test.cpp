// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The text about a measurement.
#include "delay/report.h"

#include <cmath>

#include <gmock/gmock.h>
#include <rapidjson/document.h>

namespace trk_bridge::delay::report_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr double field = 0.02;  // s

Measurement measured() {
  Measurement m;
  m.delay = 0.0432;
  m.accuracy = 0.0003;
  m.correlation = 0.998;
  m.frame_interval = 0.04;
  m.tracking_interval = field;
  m.followed = 1;
  m.axes[0] = {true, 1.002, 0.001, 0.999};
  m.axes[1] = {true, 0.999, 0.001, 0.998};
  m.focal_length_scale = 1.0005;
  m.focal_length_error = 0.0007;
  return m;
}

TEST(Report, ReportsWhichIsLaterAndTheParameterToSet) {
  auto m = measured();
  EXPECT_EQ(summary(m, field), "the video is 43.2 ms later than tracking (2.16 fields)");
  EXPECT_EQ(setting(m), "for ros_to_trk: delay:=0.0432");
  m.delay = -0.0105;
  EXPECT_EQ(summary(m, field), "tracking is 10.5 ms later than the video (0.53 fields)");
  EXPECT_EQ(setting(m), "add to the delay of trk_to_ros: 0.0105");
  EXPECT_THAT(values(m, field), Contains(Pair("delay (ms)", "-10.50")));
  m.cannot_tell = CannotTell::hardly_moved;
  EXPECT_EQ(summary(m, field), "cannot tell: the camera hardly moved");
  EXPECT_EQ(setting(m), "");
  EXPECT_THAT(values(m, field), ElementsAre(Pair("video (Hz)", "25.00"), Pair("tracking (Hz)", "50.00"),
                                            Pair("frames followed (%)", "100")));
}

TEST(Report, ReportsOnlySignificantFaults) {
  auto m = measured();
  EXPECT_THAT(faults(m), IsEmpty());
  m.axes[0].scale = -1;
  EXPECT_THAT(faults(m), ElementsAre("pan turns the wrong way"));
  m.axes[0].moved = false;
  EXPECT_THAT(faults(m), IsEmpty());
  m.focal_length_scale = 1.031;
  EXPECT_THAT(faults(m), ElementsAre("tracking's focal length is 3.0 % too short"));
  m.focal_length_error = 0.02;
  EXPECT_THAT(faults(m), IsEmpty()) << "within its error";
  m.axes[2] = {true, 0.5, 0.01, 0.9};
  EXPECT_THAT(faults(m), ElementsAre("tracking's roll is 100.0 % too large"));
}

TEST(Report, IsJson) {
  auto m = measured();
  rapidjson::Document json;
  ASSERT_FALSE(json.Parse(to_json(m, field).c_str()).HasParseError());
  EXPECT_EQ(json["delay"].GetDouble(), 0.0432);
  EXPECT_DOUBLE_EQ(json["fields"].GetDouble(), 2.16);
  EXPECT_TRUE(json["cannot_tell"].IsNull());
  EXPECT_EQ(json["axes"]["pan"]["scale"].GetDouble(), 1.002);
  EXPECT_TRUE(json["axes"]["roll"].IsNull());
  m.accuracy = INFINITY;
  ASSERT_FALSE(json.Parse(to_json(m, field).c_str()).HasParseError());
  EXPECT_TRUE(json["accuracy"].IsNull());
  m.cannot_tell = CannotTell::too_even;
  ASSERT_FALSE(json.Parse(to_json(m, field).c_str()).HasParseError());
  EXPECT_STREQ(json["cannot_tell"].GetString(), describe(CannotTell::too_even));
  EXPECT_FALSE(json.HasMember("delay"));
}

}  // namespace trk_bridge::delay::report_test
