// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor/alarm.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::monitor::alarm_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

State state_with(double loss, double rate) {
  State state;
  CameraState camera;
  camera.key.id = 7;
  camera.latest.emplace();
  camera.latest->age = 0.02;
  camera.loss = loss;
  camera.rate = rate;
  camera.intervals.assign(100, 20'000'000);
  camera.jitter = Jitter{20'000'000, 100'000, 2'500'000, 3'000'000};
  state.cameras.push_back(camera);
  return state;
}

std::vector<std::string> texts(const std::vector<std::string>& alarms, const State& state) {
  std::vector<Alarm> parsed;
  for (const auto& text : alarms) parsed.push_back(parse_alarm(text).value());
  std::vector<std::string> found;
  for (const auto& finding : raised(parsed, state)) {
    EXPECT_EQ(finding.level, bridge::Level::error);
    found.push_back(finding.text);
  }
  return found;
}

TEST(Alarm, IsRaisedOnlyBeyondItsLimit) {
  EXPECT_THAT(texts({"loss>1%", "rate<49.5Hz"}, state_with(1, 49.5)), IsEmpty());
  EXPECT_THAT(texts({"loss>1%", "rate<49.5Hz", "rate>60"}, state_with(1.5, 49.4)),
              ElementsAre("ALARM loss>1%: id 7: loss 1.50 %", "ALARM rate<49.5Hz: id 7: rate 49.40 Hz"));
  EXPECT_THAT(texts({"jitter>2ms", "jitter>3"}, state_with(0, 50)),
              ElementsAre("ALARM jitter>2ms: id 7: jitter 2.50 ms"));
}

TEST(Alarm, OfSilence) {
  auto state = state_with(0, 50);
  state.cameras.front().latest->age = 2.5;
  state.cameras.front().latest->is_silent = true;
  EXPECT_THAT(texts({"silence>2s", "silence>3s", "rate<10"}, state),
              ElementsAre("ALARM silence>2s: id 7: silence 2.50 s", "ALARM rate<10: id 7: rate 0.00 Hz"));
  State nothing;
  nothing.age = 2.5;
  EXPECT_THAT(texts({"silence>2s"}, nothing), ElementsAre("ALARM silence>2s: silence 2.50 s"));
}

TEST(Alarm, OfTheSource) {
  auto state = state_with(0, 50);
  state.recent_malformed = 1;
  state.recent_drops = 3;
  EXPECT_THAT(texts({"malformed>0", "drops>3"}, state), ElementsAre("ALARM malformed>0: malformed 1.00"));
}

TEST(Alarm, ARateNeedsASecond) {
  auto state = state_with(0, 20);
  state.cameras.front().intervals.resize(20);
  EXPECT_THAT(texts({"rate<49", "jitter>1"}, state), IsEmpty());
}

TEST(Alarm, ErrorsNameThePartAndWhatIsAllowed) {
  EXPECT_THAT(parse_alarm("los>1%").error(),
              AllOf(HasSubstr("\"los>1%\": quantity \"los\""), HasSubstr("loss (%), rate (Hz), jitter (ms)")));
  EXPECT_THAT(parse_alarm("loss=1").error(), HasSubstr("no > or <"));
  EXPECT_THAT(parse_alarm("loss>x").error(), HasSubstr("limit \"x\": allowed is a number from 0 on"));
  EXPECT_THAT(parse_alarm("loss>-1").error(), HasSubstr("limit \"-1\""));
  EXPECT_THAT(parse_alarm("loss>nan").error(), HasSubstr("limit \"nan\""));
  EXPECT_THAT(parse_alarm("jitter>2s").error(), HasSubstr("unit \"s\" of jitter: allowed is ms or none"));
  EXPECT_THAT(parse_alarm("drops>2%").error(), HasSubstr("allowed is none"));
}

}  // namespace trk_bridge::monitor::alarm_test
