#include "ros/params_to_trk.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

OutgoingForm form_of(const std::string& words) {
  OutgoingForm form;
  form.format = wire::format_from_words(words).value();
  return form;
}

trk_bridge::CameraConstants constants(std::uint32_t id = 0) {
  trk_bridge::CameraConstants m;
  to_msg({id, 720, 576, 9, 9, 0, 0, 8.8, 6.6, 0, 0}, m);
  return m;
}

wire::CameraParams record(std::uint64_t counter = 1, std::uint32_t id = 0) {
  wire::CameraParams p;
  p.id = id;
  p.format = wire::euler;
  p.euler = {0.1, -0.2, 1.7, 30.3, -5.1, 0.7};
  p.fov = 10.1;
  p.center_x = 0.01;
  p.k1 = 1e-4;
  p.focdist = 4.5;
  p.counter = counter;
  return p;
}

trk_bridge::CameraParams message(const wire::CameraParams& params) {
  trk_bridge::CameraParams m;
  to_msg(params, m);
  return m;
}

TEST(ParamsToTrk, WhatNeedsNoChangeKeepsItsDoublesItsCounterAndItsId) {
  ParamsToTrk converter({});
  const auto p = record(1000, 7);
  const auto made = converter.take(message(p), 5);
  ASSERT_TRUE(made.params);
  EXPECT_EQ(*made.params, p);
  EXPECT_FALSE(made.constants) << "none are known";
  EXPECT_EQ(converter.statistics().outgoing.sets, 1u);
  EXPECT_EQ(converter.statistics().outgoing.last_set, 5);
}

TEST(ParamsToTrk, AGivenIdCountsForParamsAndConstants) {
  OutgoingForm form;
  form.id = 3;
  ParamsToTrk converter(form);
  converter.take(constants(9));
  const auto made = converter.take(message(record(1, 7)), 0);
  ASSERT_TRUE(made.params && made.constants);
  EXPECT_EQ(made.params->id, 3u);
  EXPECT_EQ(made.constants->id, 3u);
}

TEST(ParamsToTrk, ConstantsBearTheIdOfTheParamsTheyGoWith) {
  ParamsToTrk converter({});
  converter.take(constants(0));
  EXPECT_EQ(converter.take(message(record(1, 7)), 0).constants->id, 7u);
  EXPECT_FALSE(converter.take(message(record(2, 7)), 0).constants) << "told before";
  EXPECT_EQ(converter.take(message(record(3, 8)), 0).constants->id, 8u);
}

TEST(ParamsToTrk, ChangedConstantsGoOutAgainUnchangedOnesDoNot) {
  ParamsToTrk converter({});
  converter.take(constants());
  EXPECT_TRUE(converter.take(message(record(1)), 0).constants);
  converter.take(constants());
  EXPECT_FALSE(converter.take(message(record(2)), 0).constants);
  auto other = constants();
  other.blank_left = 10;
  converter.take(other);
  const auto made = converter.take(message(record(3)), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.constants->blank_left, 10);
}

TEST(ParamsToTrk, AReceiverThatTakesNoIdIsSentNone) {
  OutgoingForm form;
  form.sends_id = false;
  form.id = 4;
  ParamsToTrk converter(form);
  converter.take(constants(4));
  const auto made = converter.take(message(record(1, 7)), 0);
  ASSERT_TRUE(made.params && made.constants);
  EXPECT_EQ(made.params->id, 0u);
  EXPECT_EQ(made.constants->id, 0u);
  EXPECT_EQ(converter.statistics().outgoing.left_out_id, 4u);
}

TEST(ParamsToTrk, ConstantsFollowTheOutgoingAspect) {
  // 720 of 702 columns are chip: 8.8 mm * 720 / 702 = 9.025641 mm; rows have no blanks.
  ParamsToTrk adjust(form_of("euler ignore_blank adjust_aspect"));
  adjust.take(constants());
  const auto adjusted = adjust.take(message(record()), 0).constants;
  ASSERT_TRUE(adjusted);
  EXPECT_NEAR(adjusted->fake_chip_width, 9.025641025641026, 1e-12);
  EXPECT_NEAR(adjusted->fake_chip_height, 6.6, 1e-12);
  ParamsToTrk keep(form_of("euler ignore_blank keep_aspect"));
  keep.take(constants());
  EXPECT_NEAR(keep.take(message(record()), 0).constants->fake_chip_height, 6.769230769230769, 1e-12);
}

TEST(ParamsToTrk, WhatNeedsUnknownConstantsIsWithheldUntilTheyCome) {
  ParamsToTrk converter(form_of("euler field_of_view"));
  EXPECT_FALSE(converter.take(message(record()), 0).params);
  EXPECT_EQ(converter.statistics().outgoing.withheld, 1u);
  EXPECT_EQ(converter.statistics().outgoing.withhold_reason, camera::CameraReason::constants_needed);
  converter.take(constants());
  const auto made = converter.take(message(record(2)), 0);
  ASSERT_TRUE(made.params && made.constants);
  EXPECT_NEAR(made.params->fov, 2 * std::atan(8.8 / 2 / 10.1) * 180 / M_PI, 1e-12);
}

TEST(ParamsToTrk, ConstantsOfTheParameterServeUntilOthersCome) {
  ParamsToTrk converter({}, wire::CameraConstants{0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 0, 0});
  EXPECT_EQ(converter.take(message(record(1)), 0).constants->image_width, 1920);
  EXPECT_FALSE(converter.statistics().constants_received);
  converter.take(constants());
  EXPECT_EQ(converter.take(message(record(2)), 0).constants->image_width, 720);
  EXPECT_TRUE(converter.statistics().constants_received);
}

TEST(ParamsToTrk, ConstantsWithoutAPictureAreIgnored) {
  ParamsToTrk converter({});
  auto bad = constants();
  bad.blank_left = 720;
  converter.take(bad);
  EXPECT_FALSE(converter.take(message(record()), 0).constants);
  EXPECT_EQ(converter.statistics().bad_constants, 1u);
}

TEST(ParamsToTrk, WhatIsNoCameraIsDropped) {
  ParamsToTrk converter({});
  auto p = record();
  p.euler.pan = std::nan("");
  EXPECT_FALSE(converter.take(message(p), 0).params);
  p = record();
  p.k2 = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(converter.take(message(p), 0).params);
  EXPECT_EQ(converter.statistics().outgoing.drop_reason, camera::CameraReason::not_finite);
  p = record();
  p.format = 0;
  p.matrix = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_FALSE(converter.take(message(p), 0).params);
  EXPECT_EQ(converter.statistics().outgoing.drop_reason, camera::CameraReason::not_a_rotation);
  EXPECT_EQ(converter.statistics().outgoing.dropped, 3u);
  EXPECT_EQ(converter.statistics().outgoing.sets, 0u);
}

}  // namespace
}  // namespace trk_bridge::ros1
