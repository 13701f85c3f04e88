// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What trk_to_ros with format:=as_received would have published, as rosbag's library reads it; and the conversion back
// to the same take.
#include <filesystem>
#include <map>

#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>
#include <trk_bridge/TimeCode.h>

#include "fixture.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag::to_bag_test {

using test::read_text;
using test::write_text;
using testing::HasSubstr;

const std::vector<std::string> field_takes{"field/takes/euler.trk",
                                           "field/takes/euler-ignore_blank-keep_aspect-field_of_view-vertical.trk",
                                           "field/takes/matrix-studio_to_camera-camera_y_up-studio_y_up.trk",
                                           "field/document_i386/ref500.trk",
                                           "field/document_lp64/ref500.trk",
                                           "field/identified_i386/ref500.trk",
                                           "field/identified_lp64/ref500.trk"};

class ToBag : public BagTest {};
class RoundTripOfTakes : public BagTest, public testing::WithParamInterface<std::string> {};

TEST_P(RoundTripOfTakes, IsTheSameTake) {
  const auto path = test::data_path(GetParam());
  const auto sent = file::read_take(path);
  const auto back = to_take(to_bag(path));
  EXPECT_EQ(back.time_code, sent.time_code);
  EXPECT_EQ(bits(back.constants), bits(sent.constants));
  EXPECT_EQ(bits_of(back.params), bits_of(sent.params));
}

INSTANTIATE_TEST_SUITE_P(FieldTakes, RoundTripOfTakes, testing::ValuesIn(field_takes),
                         [](const auto& test) { return "Take" + std::to_string(test.index); });

TEST_F(ToBag, ATakeInShortestFormIsRestoredByteForByte) {
  const auto take = take_of(some_fields(300, 7));
  for (const char* compression : {"none", "bz2", "lz4"}) {
    TakeToBagOptions options;
    options.compression = compression;
    options.overwrite = true;
    to_take(to_bag(take, options));
    EXPECT_EQ(read_text(directory / "back.trk"), read_text(take)) << compression;
  }
}

TEST_F(ToBag, ConstantsForAnyCameraKeepIdZero) {
  const auto take = directory / "any.trk";
  write_text(take,
             "DMC01\n10:20:30:12:1\n720 576 10 10 0 0 6.4 4.8 6.58286 4.8\nI7 1 0.5 -2 1.5 0 0 0 7.7 0 0 0 0 0 0 9\n");
  const auto sent = file::read_take(take);
  const auto back = to_take(to_bag(take));
  EXPECT_EQ(bits(back.constants), bits(sent.constants));
  EXPECT_EQ(bits_of(back.params), bits_of(sent.params));
}

TEST_F(ToBag, EqualTakesMakeEqualFiles) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    TakeToBagOptions options;
    options.compression = compression;
    options.overwrite = true;
    const auto take = test::data_path(field_takes[0]);
    const auto one = read_text(to_bag(take, options, "one.bag"));
    const auto other = read_text(to_bag(take, options, "other.bag"));
    EXPECT_GT(one.size(), 100'000u);
    EXPECT_TRUE(one == other) << compression;
  }
}

TEST_F(ToBag, ContainsWhatTheNodePublishes) {
  TakeToBagOptions options;
  options.camera = "crane1";
  const auto path = test::data_path("field/takes/euler.trk");
  const auto take = file::read_take(path);
  rosbag::Bag bag(to_bag(path, options));
  rosbag::View view(bag);
  std::map<std::string, std::size_t> counts;
  for (const auto& message : view) {
    ++counts[message.getTopic()];
    EXPECT_EQ(message.getCallerId(), "/crane1/trk_to_ros");
    EXPECT_EQ(message.isLatching(), message.getTopic() == "/tf_static" || message.getTopic() == "/crane1/constants");
  }
  const std::size_t fields = take.params.size();
  EXPECT_EQ(counts, (std::map<std::string, std::size_t>{{"/crane1/camera_info", fields},
                                                        {"/crane1/constants", 1},
                                                        {"/crane1/params", fields},
                                                        {"/crane1/time_code", fields},
                                                        {"/tf", fields},
                                                        {"/tf_static", 1}}));
  // 03:13:51:00:1 on 1970-01-02, 50 fields a second.
  const ::ros::Time begin(86400 + 3 * 3600 + 13 * 60 + 51, 0);
  EXPECT_EQ(view.getBeginTime(), begin);
  std::size_t params = 0;
  std::size_t infos = 0;
  for (const auto& message : view) {
    if (const auto p = message.instantiate<trk_bridge::CameraParams>()) {
      const ::ros::Duration since(static_cast<std::int32_t>(params / 50),
                                  static_cast<std::int32_t>(params % 50) * 20'000'000);
      EXPECT_EQ(p->header.stamp, begin + since);
      EXPECT_EQ(message.getTime(), p->header.stamp);
      EXPECT_EQ(p->header.frame_id, "studio");
      EXPECT_EQ(p->x, take.params[params].euler.x);
      ++params;
    } else if (const auto info = message.instantiate<sensor_msgs::CameraInfo>()) {
      EXPECT_EQ(info->header.frame_id, "crane1_optical");
      EXPECT_EQ(info->width, 720u);
      ++infos;
    } else if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) {
      ASSERT_EQ(tf->transforms.size(), 1u);
      EXPECT_EQ(tf->transforms[0].header.stamp, message.getTime());
    }
  }
  EXPECT_EQ(infos, fields);
}

TEST_F(ToBag, TimeCodesAreMessagesAndAreRestored) {
  TakeToBagOptions options;
  options.field_rate = 59.94;
  options.start = 1'700'000'000'000'000'000;  // the time code contains no time of day
  const auto take = take_of(some_fields(200), "made.trk", {0, 59, 59, 29, 1, true});
  const auto path = to_bag(take, options);
  rosbag::Bag bag(path);
  std::vector<std::string> codes;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/camera/time_code"))) {
    const auto code = message.instantiate<trk_bridge::TimeCode>();
    ASSERT_TRUE(code);
    EXPECT_EQ(code->rate, 59.94);
    EXPECT_EQ(code->header.frame_id, "studio");
    codes.push_back(base::to_string(ros1::from_msg(*code).code));
  }
  ASSERT_EQ(codes.size(), 200u);
  EXPECT_EQ(codes[0], "00:59:59;29:1");
  EXPECT_EQ(codes[2], "01:00:00;00:1");
  EXPECT_EQ(to_take(path).time_code, file::read_take(take).time_code);
}

TEST_F(ToBag, TheDayAndTheStartCanBeSet) {
  const auto take = take_of(some_fields(3));
  const auto begin = [&](const TakeToBagOptions& options) {
    rosbag::Bag bag(to_bag(take, options));
    return rosbag::View(bag).getBeginTime();
  };
  TakeToBagOptions options;
  options.overwrite = true;
  options.midnight = 1'795'305'600'000'000'000;  // 2026-11-22
  // 10:20:30:12:1
  EXPECT_EQ(begin(options), ::ros::Time(1'795'305'600 + 37'230, 480'000'000));
  options.start = 1'700'000'000'123'456'789;
  EXPECT_EQ(begin(options), ::ros::Time(1'700'000'000, 123'456'789));
  EXPECT_EQ(to_take(directory / "a.bag").time_code, file::read_take(take).time_code);
}

TEST_F(ToBag, TheFieldRateIsKeptInTheBag) {
  for (const double rate : {23.976, 25.0, 59.94, 60000.0 / 1001.0, 119.88}) {
    TakeToBagOptions options;
    options.field_rate = rate;
    options.overwrite = true;
    const auto take = take_of(some_fields(400), "made.trk", {23, 59, 59, 3, 2});
    to_take(to_bag(take, options));
    EXPECT_EQ(read_text(directory / "back.trk"), read_text(take)) << rate;
  }
}

TEST_F(ToBag, ParamsCanBeConvertedToAnotherFormat) {
  TakeToBagOptions options;
  options.format = wire::euler | wire::studio_y_up;
  const auto back = to_take(to_bag(take_of(some_fields(1)), options));
  EXPECT_EQ(back.params.at(0).format, 9u);
  EXPECT_NEAR(back.params[0].euler.z, 2, 1e-12);
  EXPECT_EQ(back.params[0].euler.y, some_params(1000).euler.z);
}

TEST_F(ToBag, WhatTheNodeWouldNotPublishIsReportedAndOmitted) {
  to_bag(take_of({some_params(5), some_params(6), some_params(6), some_params(7)}));
  EXPECT_THAT(err.str(), HasSubstr("1 fields are not in the bag: their counter is not new"));
  EXPECT_EQ(to_take(directory / "a.bag").params.size(), 3u);
}

TEST_F(ToBag, AnEmptyTakeMakesABagWithItsConstants) {
  rosbag::Bag bag(to_bag(take_of({})));
  EXPECT_EQ(rosbag::View(bag).size(), 2u);
}

TEST_F(ToBag, ExistingFilesAreReplacedOnlyWhenAsked) {
  const auto take = take_of(some_fields(3));
  write_text(directory / "a.bag", "precious");
  EXPECT_THROW(to_bag(take), std::runtime_error);
  EXPECT_EQ(read_text(directory / "a.bag"), "precious");
  EXPECT_FALSE(std::filesystem::exists(directory / "a.bag.part"));
  TakeToBagOptions options;
  options.overwrite = true;
  to_bag(take, options);
  EXPECT_EQ(to_take(directory / "a.bag").params.size(), 3u);
}

TEST_F(ToBag, WrongOptionsAreNamedAndLeaveNoFile) {
  const auto take = take_of(some_fields(3));
  const auto refused = [&](const TakeToBagOptions& options) {
    std::string error = test::error_of<std::runtime_error>([&] { to_bag(take, options); });
    EXPECT_FALSE(std::filesystem::exists(directory / "a.bag"));
    EXPECT_FALSE(std::filesystem::exists(directory / "a.bag.part"));
    return error;
  };
  TakeToBagOptions options;
  options.camera = "no name";
  EXPECT_THAT(refused(options), HasSubstr("--camera = 'no name'"));
  options = {};
  options.optical_frame = "/optical";
  EXPECT_THAT(refused(options), HasSubstr("--optical-frame = '/optical': must be a tf frame"));
  options = {};
  options.camera_frame = options.studio_frame;
  EXPECT_THAT(refused(options), HasSubstr("'studio': studio, camera and optical frame must differ"));
  options = {};
  options.field_rate = 0;
  EXPECT_THAT(refused(options), HasSubstr("--field-rate = 0: must be 1 to 1000 Hz"));
  options = {};
  options.field_rate = 12;
  EXPECT_THAT(refused(options), HasSubstr("10:20:30:12:1"));
  options = {};
  options.start = 4'294'967'295'990'000'000;
  EXPECT_THAT(refused(options), HasSubstr("1970 to 2106"));
}

}  // namespace trk_bridge::bag::to_bag_test
