// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Takes from recordings of params and constants, also incomplete ones.
#include <cmath>
#include <limits>

#include <std_msgs/String.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "fixture.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::bag::from_params_test {

using testing::HasSubstr;
using testing::Not;

CameraConstants constants_message(std::uint32_t id = 0, double chip_width = 9.59) {
  auto constants = some_constants(id);
  constants.chip_width = chip_width;
  CameraConstants message;
  ros1::to_msg(constants, message);
  return message;
}

CameraParams params_message(const wire::CameraParams& params, double stamp) {
  CameraParams message;
  message.header.stamp = ::ros::Time(stamp);
  ros1::to_msg(params, message);
  return message;
}

class FromParams : public BagTest {
 protected:
  void put_constants(const std::string& camera = "/crane", std::uint32_t id = 0) {
    bag.put(camera + "/constants", 99.5, constants_message(id));
  }
  void put(const std::vector<std::uint64_t>& counters, const std::string& camera = "/crane", double rate = 50) {
    for (const auto counter : counters) {
      // 02:46:40 after midnight.
      const double stamp = 10'000 + static_cast<double>(counter) / rate;
      bag.put(camera + "/params", stamp, params_message(some_params(counter), stamp));
    }
  }
  static std::vector<std::uint64_t> counted(std::uint64_t from, std::uint64_t to) {
    std::vector<std::uint64_t> counters;
    for (; from < to; ++from) counters.push_back(from);
    return counters;
  }

  SomeBag bag{directory / "some.bag"};
};

TEST_F(FromParams, TheTimeCodeIsThatOfTheFirstStamp) {
  put_constants();
  put(counted(125, 135));
  const auto take = to_take(bag.closed());
  EXPECT_EQ(to_string(take.time_code), "02:46:42:12:2");
  ASSERT_EQ(take.params.size(), 10u);
  EXPECT_EQ(bits(take.params[3]), bits(some_params(128)));
  EXPECT_THAT(err.str(), Not(HasSubstr("missing")));
}

TEST_F(FromParams, GapsAreReportedAndNotFilled) {
  put_constants();
  put({100, 101, 105, 106, 110});
  EXPECT_EQ(to_take(bag.closed()).params.size(), 5u);
  EXPECT_THAT(err.str(), HasSubstr("6 fields are missing in 2 gaps, the first of 3 after 10002.020000000"));
}

TEST_F(FromParams, StampsThatContradictTheDefaultFieldRateNeedTheOption) {
  put_constants();
  put(counted(0, 300), "/crane", 59.94);
  const auto path = bag.closed();
  EXPECT_THAT(refusal(path), HasSubstr("59.94 fields a second, not 50: set --field-rate HZ"));
  BagToTakeOptions options;
  options.field_rate = 59.94;
  EXPECT_EQ(to_take(path, options).params.size(), 300u);
}

TEST_F(FromParams, TheChipIsThatOfTheConstants) {
  put_constants();
  put(counted(1, 4));
  BagToTakeOptions options;
  options.chip_width = 9.59;
  EXPECT_THAT(refusal(bag.closed(), options),
              HasSubstr("--chip-width, --chip-height: for bags without constants; this one has them"));
}

TEST_F(FromParams, OneOfSeveralCamerasMustBeChosen) {
  put_constants("/left");
  put(counted(1, 4), "/left");
  put_constants("/studio/right");
  put(counted(1, 6), "/studio/right");
  const auto path = bag.closed();
  EXPECT_THAT(refusal(path), HasSubstr("--camera must name one: left (params), studio/right (params)"));
  BagToTakeOptions options;
  options.camera = "left";
  EXPECT_EQ(to_take(path, options).params.size(), 3u);
  options.camera = "/studio/right";
  EXPECT_EQ(to_take(path, options).params.size(), 5u);
  options.camera = "middle";
  EXPECT_THAT(refusal(path, options), HasSubstr("camera middle has no topic"));
}

TEST_F(FromParams, OtherTypesAreNamed) {
  std_msgs::String text;
  bag.put("/crane/params", 100, text);
  const auto path = bag.closed();
  EXPECT_THAT(refusal(path), HasSubstr("the bag has no camera"));
  BagToTakeOptions options;
  options.camera = "crane";
  EXPECT_THAT(refusal(path, options),
              HasSubstr("/crane/params is of type std_msgs/String, not trk_bridge/CameraParams"));
}

TEST_F(FromParams, WithoutConstantsThereIsNoTake) {
  put(counted(1, 4));
  EXPECT_THAT(refusal(bag.closed()), HasSubstr("/crane/constants"));
}

TEST_F(FromParams, ConstantsMayBeLateAndRepeatedButNotChange) {
  put(counted(1, 4));
  put_constants();
  put(counted(4, 8));
  bag.put("/crane/constants", 10'001, constants_message());
  EXPECT_EQ(to_take(bag.closed()).params.size(), 7u);

  SomeBag other(directory / "other.bag");
  other.put("/crane/constants", 99, constants_message());
  other.put("/crane/params", 100, params_message(some_params(1), 100));
  other.put("/crane/constants", 101, constants_message(0, 6.4));
  EXPECT_THAT(refusal(other.closed()), HasSubstr("the constants change"));
}

TEST_F(FromParams, InvalidConstantsAreRefused) {
  bag.put("/crane/constants", 99.5, constants_message(0, -1));
  put(counted(1, 4));
  EXPECT_THAT(refusal(bag.closed()), HasSubstr("the constants at "));
}

TEST_F(FromParams, ATakeContainsOneId) {
  put_constants("/crane", 5);
  bag.put("/crane/params", 100, params_message(some_params(1, 7), 100));
  EXPECT_EQ(to_take(bag.closed()).constants.id, 7u);
  EXPECT_THAT(err.str(), HasSubstr("the constants have id 5, the parameters 7"));

  SomeBag other(directory / "other.bag");
  other.put("/crane/constants", 99, constants_message());
  other.put("/crane/params", 100, params_message(some_params(1, 7), 100));
  other.put("/crane/params", 101, params_message(some_params(2, 8), 101));
  const auto path = other.closed();
  EXPECT_THAT(refusal(path), HasSubstr("ids 7 and 8"));
  BagToTakeOptions options;
  options.id = 3;
  EXPECT_EQ(to_take(path, options).params.at(1).id, 3u);
}

TEST_F(FromParams, AWarningReplacesTheProgressLine) {
  for (std::uint64_t fields = 20'000; err.str().find("trk: reading") == std::string::npos; fields *= 2) {
    ASSERT_LT(fields, 10'000'000u) << "no progress is shown, independent of how long reading takes";
    SomeBag many(directory / "many.bag", rosbag::compression::BZ2);
    many.put("/crane/constants", 99, constants_message(5));
    for (std::uint64_t i = 0; i < fields; ++i) {
      const double stamp = 100 + static_cast<double>(i) / 50;
      many.put("/crane/params", stamp, params_message(some_params(i, 7), stamp));
    }
    err.str("");
    cli::LongRun terminal{err, /*is_terminal=*/true};
    BagToTakeOptions options;
    options.overwrite = true;
    take_of_bag(many.closed(), directory / "back.trk", options, terminal, err);
  }
  EXPECT_THAT(err.str(), HasSubstr("%\r\033[Ktrk: the constants have id 5, the parameters 7"));
}

TEST_F(FromParams, FieldsThatATakeCannotContainAreOmittedAndReported) {
  put_constants();
  put(counted(1, 3));
  auto bad = some_params(3);
  bad.fov = std::numeric_limits<double>::quiet_NaN();
  bag.put("/crane/params", 10'001, params_message(bad, 10'001));
  EXPECT_EQ(to_take(bag.closed()).params.size(), 2u);
  EXPECT_THAT(err.str(), HasSubstr("omitted: 1 fields, the first at 10001.000000000: field 8 is not finite"));
}

TEST_F(FromParams, ParamsCanBeConvertedToAnotherFormat) {
  put_constants();
  put(counted(1, 3));
  BagToTakeOptions options;
  options.format = 0x19;  // euler studio_y_up field_of_view
  const auto take = to_take(bag.closed(), options);
  EXPECT_EQ(take.params.at(0).format, 0x19u);
  EXPECT_NEAR(take.params[0].fov, 2 * std::atan(9.59 / 2 / 7.7) * 180 / M_PI, 1e-9);
}

}  // namespace trk_bridge::bag::from_params_test
