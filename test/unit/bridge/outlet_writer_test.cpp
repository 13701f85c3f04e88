// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/outlet_writer.h"

#include <cerrno>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "controlled_sink.h"
#include "endpoints/presets.h"
#include "trk_bridge/wire/format.h"
#include "udp.h"

namespace trk_bridge::bridge::outlet_writer_test {

using camera::CameraReason;
using test::constants;
using test::params;
using testing::ElementsAre;
using testing::IsEmpty;
using transport::SinkFault;
using transport::SinkReason;

transport::SinkForm form_of(const std::string& words) {
  transport::SinkForm form;
  form.format = wire::format_from_words(words).value();
  return form;
}

transport::SinkForm form_of_preset(const std::string& name) {
  const auto preset = endpoints::find_preset(name).value();
  transport::SinkForm form;
  form.format = preset.format;
  form.sends_id = preset.sends_id;
  return form;
}

class OutletWriterTest : public testing::Test {
 protected:
  OutletWriterTest() { control.open(); }
  OutletWriter writer(const transport::SinkForm& form = {}, Feed feed = Feed::passed_on) {
    return {std::make_unique<test::ControlledSink>(control, "control"), form, feed,
            [this](const Loss& loss) { losses.push_back(loss); }};
  }

  test::SinkControl control;
  std::vector<Loss> losses;
};

TEST_F(OutletWriterTest, WithoutAFormatEveryNumberStays) {
  auto outlet = writer();
  auto odd = params(1, 3);
  odd.format |= 0x8000;
  odd.fov = std::numeric_limits<double>::infinity();
  outlet.write(constants(720, 3));
  outlet.write(odd);
  outlet.write(constants(-1, 3));
  EXPECT_THAT(control.records(), ElementsAre(constants(720, 3), odd, constants(-1, 3)));
  outlet.write(constants(720, 3));
  EXPECT_EQ(control.records().size(), 4u) << "the receiver has received others since";
  EXPECT_THAT(losses, IsEmpty());
}

TEST_F(OutletWriterTest, OneFeedIsRightForReceiversOfTwoFormats) {
  test::SinkControl other;
  other.open();
  auto aximmetry = writer(form_of_preset("aximmetry"), Feed::one_camera);
  OutletWriter pixotope(std::make_unique<test::ControlledSink>(other, "other"), form_of_preset("pixotope"),
                        Feed::one_camera);
  auto wide = constants(720, 7);
  wide.blank_left = wide.blank_right = 10;
  wide.fake_chip_width = wide.fake_chip_height = 0;
  const auto set = params(1, 7);
  for (auto* one : {&aximmetry, &pixotope}) {
    one->write(wide);
    one->write(set);
  }
  ASSERT_EQ(control.params().size(), 1u);
  ASSERT_EQ(other.params().size(), 1u);
  EXPECT_EQ(other.params()[0], set) << "already in its format: identical doubles";
  const auto turned = control.params()[0];
  const auto sent_constants = control.constants()[0], plain_constants = other.constants()[0];
  EXPECT_EQ(turned.format,
            std::uint32_t{wire::camera_y_up | wire::studio_y_up | wire::field_of_view | wire::ignore_blank});
  // y-up studio: x, z, -y of the z-up one.
  EXPECT_NEAR(turned.matrix[12], 1.5, 1e-12);
  EXPECT_NEAR(turned.matrix[13], 1.75, 1e-12);
  EXPECT_NEAR(turned.matrix[14], 2, 1e-12);
  // Blanks are ignored: the angle is that of a chip larger by 720 / 700, for the same picture.
  EXPECT_NEAR(turned.fov, 2 * std::atan(8.8 * 720 / 700 / 2 / 42) * 180 / M_PI, 1e-9);
  EXPECT_NEAR(sent_constants.fake_chip_width, 8.8 * 720 / 700, 1e-12) << "adjusted aspect";
  EXPECT_NEAR(sent_constants.fake_chip_height, 6.6, 1e-12);
  // Each receiver's constants and parameters describe the same camera.
  const auto first = camera::decode(turned, &sent_constants);
  const auto second = camera::decode(set, &plain_constants);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(first->pose.isApprox(second->pose, 1e-12));
  EXPECT_NEAR(first->lens.image_distance, second->lens.image_distance, 1e-9);
}

TEST_F(OutletWriterTest, TheIdOfTheFormIsUsedForParamsAndConstants) {
  transport::SinkForm form;
  form.id = 3;
  auto outlet = writer(form);
  outlet.write(constants(720, 9));
  outlet.write(params(1, 7));
  EXPECT_THAT(control.records(), ElementsAre(constants(720, 3), params(1, 3)));
  EXPECT_EQ(outlet.statistics().last_id, 3u);
}

TEST_F(OutletWriterTest, AReceiverWithoutIdsIsSentNone) {
  auto form = form_of_preset("unreal_trackmen");
  form.id = 4;
  auto outlet = writer(form);
  outlet.write(constants(720, 4));
  outlet.write(params(1, 7));
  ASSERT_EQ(control.records().size(), 2u);
  EXPECT_EQ(control.constants()[0].id, 0u);
  EXPECT_EQ(control.params()[0].id, 0u);
  EXPECT_EQ(outlet.statistics().unsent_id, 4u);
}

TEST_F(OutletWriterTest, OnlyNewConstantsAreSent) {
  auto outlet = writer(form_of("euler"));
  outlet.write(constants());
  outlet.write(constants());
  outlet.write(params(1));
  outlet.write(constants());
  EXPECT_EQ(control.constants().size(), 1u);
  outlet.write(constants(1920));
  EXPECT_EQ(control.constants().size(), 2u);
}

TEST_F(OutletWriterTest, ConstantsOfOneCameraAreUsedForAllIdsAndSentAgainWhenTheIdChanges) {
  auto outlet = writer(form_of("euler field_of_view"), Feed::one_camera);
  outlet.write(constants(720, 7));
  outlet.write(params(1, 8));
  EXPECT_EQ(control.params().size(), 1u);
  outlet.write(constants(720, 8));
  outlet.write(constants(720, 7));
  EXPECT_THAT(control.constants(), ElementsAre(constants(720, 7), constants(720, 8), constants(720, 7)));
}

TEST_F(OutletWriterTest, ConstantsAreKeptById) {
  auto outlet = writer(form_of("euler field_of_view"));
  outlet.write(constants(720, 7));
  outlet.write(params(1, 8));
  EXPECT_THAT(control.params(), IsEmpty()) << "none for 8";
  EXPECT_EQ(outlet.statistics().withheld, 1u);
  EXPECT_EQ(outlet.statistics().withhold_reason, CameraReason::constants_needed);
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].id, 8u);
  EXPECT_EQ(std::get<CameraReason>(losses[0].cause), CameraReason::constants_needed);
  outlet.write(params(1, 7));
  EXPECT_EQ(control.params().size(), 1u);
}

TEST_F(OutletWriterTest, TheNumberOfIdsIsLimited) {
  auto outlet = writer();
  for (std::uint32_t id = 0; id < 300; ++id) outlet.write(constants(720, id));
  EXPECT_EQ(control.constants().size(), OutletWriter::most_ids);
  EXPECT_EQ(outlet.statistics().refused_constants, 300 - OutletWriter::most_ids);
  ASSERT_EQ(losses.size(), 300 - OutletWriter::most_ids);
  EXPECT_EQ(std::get<OutletReason>(losses[0].cause), OutletReason::too_many_ids);
  outlet.write(constants(1920, 3));
  EXPECT_EQ(control.constants().back().image_width, 1920) << "known ids continue";
  outlet.write(params(1, 299));
  EXPECT_EQ(control.params().size(), 1u);
}

TEST_F(OutletWriterTest, InvalidConstantsInvalidateEarlierOnes) {
  auto outlet = writer(form_of("euler field_of_view"));
  outlet.write(constants(720));
  outlet.write(constants(-1));
  outlet.write(params(1));
  EXPECT_THAT(control.records(), ElementsAre(constants(720)));
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(std::get<CameraReason>(losses[0].cause), CameraReason::bad_constants);
  EXPECT_EQ(std::get<CameraReason>(losses[1].cause), CameraReason::constants_needed);
  outlet.write(constants(720));
  outlet.write(params(2));
  EXPECT_EQ(control.constants().size(), 2u);
  EXPECT_EQ(control.params().size(), 1u);
}

TEST_F(OutletWriterTest, ConstantsThatCouldNotBeWrittenAreRetriedBeforeEverySet) {
  auto outlet = writer(form_of("euler"));
  control.set_fault(SinkFault{SinkReason::system, {}, ENOSPC});
  outlet.write(constants());
  EXPECT_EQ(losses.size(), 1u);
  outlet.write(params(1));
  EXPECT_EQ(losses.size(), 2u) << "only the parameters: a set is not tried twice";
  EXPECT_EQ(outlet.statistics().failed_sets, 1u);
  outlet.write(params(2));
  EXPECT_EQ(losses.size(), 4u);
  EXPECT_TRUE(outlet.statistics().fails);
  EXPECT_EQ(outlet.statistics().last_fault.error_number, ENOSPC);
  control.set_fault(std::nullopt);
  outlet.write(params(3));
  outlet.write(params(4));
  EXPECT_THAT(control.records(), ElementsAre(constants(), params(3), params(4)));
  EXPECT_FALSE(outlet.statistics().fails);
  EXPECT_EQ(outlet.statistics().failed_sets, 2u);
  EXPECT_GT(outlet.statistics().last_success, outlet.statistics().last_failure);
}

TEST_F(OutletWriterTest, InvalidConstantsEndTheRetriesOfRefusedOnes) {
  for (const auto& form : {transport::SinkForm{}, form_of("euler")}) {
    auto outlet = writer(form);
    outlet.write(constants(720));
    outlet.write(params(1));
    // Like a file, which contains one set of constants.
    control.set_fault(SinkFault{SinkReason::constants_changed});
    outlet.write(constants(1920));
    outlet.write(params(2));
    outlet.write(wire::CameraConstants{});
    control.set_fault(std::nullopt);
    const auto before = control.count();
    outlet.write(params(3));
    EXPECT_EQ(control.count(), before + 1) << "no constants before it";
    EXPECT_EQ(control.params().back(), params(3));
    EXPECT_FALSE(outlet.statistics().fails);
    EXPECT_EQ(outlet.statistics().failed_sets, 1u);
    outlet.write(constants(1920));
    EXPECT_EQ(control.constants().back(), constants(1920)) << "new again";
  }
}

TEST_F(OutletWriterTest, InvalidCamerasAreDroppedFromTheFeedOfOneCamera) {
  auto strict = writer(form_of("euler"), Feed::one_camera);
  auto nowhere = params(1);
  nowhere.euler.pan = std::nan("");
  strict.write(nowhere);
  auto no_lens = params(2);
  no_lens.k2 = std::numeric_limits<double>::infinity();
  strict.write(no_lens);
  EXPECT_EQ(strict.statistics().drop_reason, CameraReason::not_finite);
  auto doubled = params(3);
  doubled.format = 0;
  doubled.euler = {};
  doubled.matrix = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  strict.write(doubled);
  EXPECT_EQ(strict.statistics().drop_reason, CameraReason::not_a_rotation);
  EXPECT_EQ(strict.statistics().dropped, 3u);
  EXPECT_THAT(control.records(), IsEmpty());
  auto plain = writer();
  plain.write(doubled);
  EXPECT_THAT(control.records(), ElementsAre(doubled));
}

}  // namespace trk_bridge::bridge::outlet_writer_test
