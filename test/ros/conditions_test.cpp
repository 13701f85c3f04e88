// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Faulty records must not reach tf, and must be reported.
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>
#include <trk_bridge/TimeCode.h>

#include <algorithm>

#include "fixture.h"
#include "repeating.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::test::conditions_test {

using diagnostic_msgs::DiagnosticStatus;

class Conditions : public TrkToRosTest {
 protected:
  void open(const std::string& options = "") {
    set("source", any_udp_port + options);
    params.emplace(name_space + "/params");
    constants.emplace(name_space + "/constants");
    infos.emplace(name_space + "/camera_info");
    transforms.emplace("/tf", camera);
    ASSERT_TRUE(starts());
    tracker.emplace(port());
  }

  bool counters_are(const std::vector<std::uint64_t>& expected) {
    const auto counters = [this] {
      std::vector<std::uint64_t> all;
      for (const auto& message : params->messages) all.push_back(message.counter);
      return all;
    };
    return eventually([&] { return counters() == expected; });
  }

  std::optional<Recorder<trk_bridge::CameraParams>> params;
  std::optional<Recorder<trk_bridge::CameraConstants>> constants;
  std::optional<Recorder<sensor_msgs::CameraInfo>> infos;
  std::optional<TransformRecorder> transforms;
  std::optional<Tracker> tracker;
};

TEST_F(Conditions, DuplicatesAndLateRecordsAreNeverPublishedRestartsAre) {
  ASSERT_NO_FATAL_FAILURE(open());
  for (const std::uint64_t counter : {1000U, 1001U, 1001U, 1004U, 1003U, 1005U, 3U, 4U, 3U})
    tracker->send(test::params(counter));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "duplicate", "2"));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "out of order", "1"));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "lost", "1"));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "restarts", "1"));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "received", "6"));
  EXPECT_TRUE(counters_are({1000, 1001, 1004, 1005, 3, 4}));
  ASSERT_TRUE(eventually([this] { return transforms->transforms.size() == 6; }));
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_GT(transforms->transforms[i].header.stamp, transforms->transforms[i - 1].header.stamp);
  }
}

TEST_F(Conditions, ASecondSenderIsIgnoredAndNamedUntilTheFirstIsSilent) {
  ASSERT_NO_FATAL_FAILURE(open());
  const Tracker second(port());
  const auto sender = [this](const std::string& key) { return diagnostics.value(status_name(), key); };
  tracker->send(test::params(1));
  ASSERT_TRUE(counters_are({1}));
  ASSERT_TRUE(diagnostics.becomes(status_name(), "received", "1"));
  const std::string first_address = sender("sender");
  {
    std::uint64_t counter = 1;
    const Repeating both(50, [&] {
      tracker->send(test::params(++counter));
      second.send(test::params(1'000'000 + counter));
    });
    ASSERT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN,
                                    "are ignored: this camera follows " + first_address));
    ASSERT_TRUE(eventually([this] { return params->messages.size() > 20; }));
    EXPECT_TRUE(std::all_of(params->messages.begin(), params->messages.end(),
                            [](const auto& message) { return message.counter < 1'000'000; }));
  }
  // The first is silent from now on.
  std::uint64_t counter = 2'000'000;
  const Repeating alone(50, [&] { second.send(test::params(++counter)); });
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, first_address + " was silent for 0.5 s"));
  EXPECT_TRUE(eventually([this] { return params->messages.back().counter > 2'000'000; }));
  EXPECT_NE(sender("sender"), first_address);
}

TEST_F(Conditions, TheFirstRateIsThatOfTheRecordsSinceTheStart) {
  std::optional<std::string> first;
  const ::ros::Subscriber subscriber = ::ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>(
      diagnostics.topic(), 100, [&](const diagnostic_msgs::DiagnosticArrayConstPtr& message) {
        for (const auto& status : message->status) {
          if (!first && status.message.find("receiving from") == 0) first = status.message;
        }
      });
  const ReservedPort reserved;
  set("source", reserved.url());
  const Tracker early(reserved.number());
  // The first diagnostics already have records.
  std::uint64_t counter = 0;
  const Repeating sending(50, [&] { early.send(test::params(++counter)); });
  start();
  ASSERT_TRUE(eventually([&] { return first.has_value(); }));
  const double rate = std::stod(first->substr(first->find(" at ") + 4));
  EXPECT_GT(rate, 5) << *first;
}

TEST_F(Conditions, OnlyMalformedDatagramsAreLost) {
  ASSERT_NO_FATAL_FAILURE(open());
  tracker->send_bytes("hello");
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "datagrams arrive, but none is trk"));
  tracker->send(test::params(1));
  tracker->send_bytes(std::string("DMC01\0PA1 1 2 3 4", 17));
  tracker->send_bytes("");
  tracker->send_bytes(std::string("DMC01\0PA1 nan 2 3 0 0 0 10 0 0 0 0 0 0 2", 40));
  tracker->send(test::params(2));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "malformed", "4"));
  EXPECT_TRUE(counters_are({1, 2}));
  EXPECT_TRUE(eventually([this] { return transforms->transforms.size() == 2; }));
}

TEST_F(Conditions, InvalidRotationsNeverReachTf) {
  ASSERT_NO_FATAL_FAILURE(open());
  auto mirrored = test::params(2);
  mirrored.format = 0;
  mirrored.matrix = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  tracker->send(test::params(1));
  tracker->send(mirrored);
  tracker->send(test::params(3));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "dropped", "1"));
  EXPECT_TRUE(counters_are({1, 3}));
  EXPECT_TRUE(eventually([this] { return transforms->transforms.size() == 2; }));
}

TEST_F(Conditions, SilenceIsReportedAndNothingIsRepeated) {
  ASSERT_NO_FATAL_FAILURE(open());
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::STALE, "nothing received yet"));
  tracker->send(test::params(1));
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "nothing new for"));
  EXPECT_EQ(transforms->transforms.size(), 1u);
}

TEST_F(Conditions, SendersThatAreNotAllowed) {
  ASSERT_NO_FATAL_FAILURE(open("?allow=127.0.0.2"));
  tracker->send(test::params(1));
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "senders that are not allowed"));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "refused senders", "1"));
  EXPECT_TRUE(transforms->transforms.empty());
}

TEST_F(Conditions, IdsOfNoCamera) {
  set("id", 7);
  ASSERT_NO_FATAL_FAILURE(open());
  tracker->send(test::params(1, 3));
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "none with id 7; seen: 3"));
  tracker->send(test::params(1, 7));
  EXPECT_TRUE(counters_are({1}));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "unknown ids", "1"));
}

TEST_F(Conditions, LateConstants) {
  ASSERT_NO_FATAL_FAILURE(open());
  auto angle = test::params(1);
  angle.format |= wire::field_of_view;
  angle.fov = 50;
  tracker->send(angle);
  ASSERT_TRUE(eventually([this] { return transforms->transforms.size() == 1; })) << "the pose needs no constants";
  EXPECT_TRUE(diagnostics.becomes(status_name(), "withheld", "1"));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "constants known", "no"));
  EXPECT_TRUE(params->messages.empty());
  EXPECT_TRUE(infos->messages.empty());

  tracker->send(test::constants());
  tracker->send(test::constants());
  angle.counter = 2;
  tracker->send(angle);
  EXPECT_TRUE(counters_are({2}));
  EXPECT_TRUE(eventually([this] { return infos->messages.size() == 1 && constants->messages.size() == 1; }));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "constants known", "received"));
  // Latched: a later subscriber also receives them.
  Recorder<trk_bridge::CameraConstants> late(name_space + "/constants");
  EXPECT_TRUE(eventually([&late] { return late.messages.size() == 1; }));
  EXPECT_EQ(constants->messages.size(), 1u) << "unchanged constants are not published again";
}

TEST_F(Conditions, WithoutConstantsParamsThatNeedNoneArePublishedWithoutCameraInfo) {
  ASSERT_NO_FATAL_FAILURE(open());
  tracker->send(test::params(1));
  EXPECT_TRUE(counters_are({1}));
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "no constants yet"));
  EXPECT_TRUE(infos->messages.empty());
}

TEST_F(Conditions, ConstantsOfTheParameterAreUsedUntilOthersAreReceived) {
  set("constants/image_width", 1280);
  set("constants/image_height", 720);
  set("constants/chip_width", 9.59);
  set("constants/chip_height", 5.39);
  ASSERT_NO_FATAL_FAILURE(open());
  ASSERT_TRUE(eventually([this] { return constants->messages.size() == 1; })) << "published at the start";
  tracker->send(test::params(1));
  ASSERT_TRUE(eventually([this] { return infos->messages.size() == 1; }));
  EXPECT_EQ(infos->messages[0].width, 1280u);
  tracker->send(test::constants(1920));
  tracker->send(test::params(2));
  ASSERT_TRUE(eventually([this] { return infos->messages.size() == 2; }));
  EXPECT_EQ(infos->messages[1].width, 1920u);
  EXPECT_TRUE(eventually([this] { return constants->messages.back().image_width == 1920; }));
}

TEST_F(Conditions, DelayIsSubtractedFromEveryStamp) {
  set("delay", 5.0);
  ASSERT_NO_FATAL_FAILURE(open());
  const auto before = ::ros::Time::now();
  tracker->send(test::params(1));
  ASSERT_TRUE(eventually([this] { return transforms->transforms.size() == 1 && params->messages.size() == 1; }));
  const auto stamp = transforms->transforms[0].header.stamp;
  EXPECT_GE(stamp, before - ::ros::Duration(5));
  EXPECT_LE(stamp, ::ros::Time::now() - ::ros::Duration(5));
  EXPECT_EQ(params->messages[0].header.stamp, stamp);
}

class TakePlayed : public TrkToRosTest {};

TEST_F(TakePlayed, TheTimeCodeOfEveryFieldIsPublished) {
  const TemporaryDirectory folder;
  const std::string take = folder / "take.trk";
  write_text(take,
             "DMC01\n10:59:59;28:1\n1920 1080 14 2 12 4 27 18 27 18\n1 1 2 3 4 5 6 50 0 0 0 0 5 8 1\n"
             "1 1 2 3 4 5 6 50 0 0 0 0 5 8 2\n1 1 2 3 4 5 6 50 0 0 0 0 5 8 3\n");
  set("source", "file:" + take + "?rate=29.97&loop=1");
  Recorder<trk_bridge::TimeCode> codes(name_space + "/time_code");
  Recorder<trk_bridge::CameraParams> params(name_space + "/params");
  ASSERT_TRUE(starts());
  ASSERT_TRUE(eventually([&] { return codes.messages.size() >= 6 && params.messages.size() >= 6; }));
  const char* const expected[] = {"10:59:59;28:1", "10:59:59;29:1", "11:00:00;00:1"};
  for (const auto& message : codes.messages) {
    const auto of_params = std::find_if(params.messages.begin(), params.messages.end(),
                                        [&](const auto& p) { return p.header.stamp == message.header.stamp; });
    if (of_params == params.messages.end()) continue;
    EXPECT_EQ(base::to_string(ros1::from_msg(message).code), expected[of_params->counter - 1]);
    EXPECT_EQ(message.rate, 29.97);
  }
}

TEST_F(Conditions, ABurstArrivesCompletely) {
  ASSERT_NO_FATAL_FAILURE(open());
  for (std::uint64_t counter = 1; counter <= 80; ++counter) tracker->send(test::params(counter));
  EXPECT_TRUE(eventually([this] { return params->messages.size() == 80 && transforms->transforms.size() == 80; }));
  EXPECT_TRUE(diagnostics.becomes(status_name(), "received", "80"));
  EXPECT_EQ(diagnostics.value(status_name(), "lost"), "0");
}

}  // namespace trk_bridge::test::conditions_test
