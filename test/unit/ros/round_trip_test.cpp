// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// trk to ROS and back is the same camera: through CameraParams, and through tf and CameraInfo.
#include <gmock/gmock.h>

#include "../camera/random_cameras.h"
#include "../camera/worked_cases.h"
#include "bridge/camera_pipeline.h"
#include "bridge/outlet_writer.h"
#include "bridge/params_to_trk.h"
#include "bridge/tf_to_trk.h"
#include "controlled_sink.h"
#include "ros/camera_info.h"
#include "ros/camera_messages.h"
#include "same_camera.h"
#include "trk_bridge/camera/image.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1::round_trip_test {

constexpr std::int64_t today = 1'700'000'000'000'000'000;

/// A record, its constants and the camera that both describe.
struct Case {
  wire::CameraParams params;
  wire::CameraConstants constants;
  camera::Camera camera;
};

constexpr std::uint32_t other_format =
    wire::studio_to_camera | wire::camera_y_up | wire::field_of_view | wire::diagonal;

bridge::CameraOptions published_in(std::optional<std::uint32_t> format) {
  bridge::CameraOptions options;
  options.format = format;
  return options;
}

/// In words, as a user writes it.
transport::SinkForm form_of(const Case& c) {
  transport::SinkForm form;
  form.format = wire::format_from_words(wire::format_to_words(c.params.format)).value();
  return form;
}

/// The messages of a case.
class Incoming {
 public:
  Incoming(const Case& c, std::optional<std::uint32_t> format) : messages_({"studio", "crane1", "crane1_optical"}) {
    bridge::CameraPipeline pipeline(published_in(format), 50);
    transport::Sample sample;
    sample.arrival = today;
    sample.record = c.constants;
    messages_.make(pipeline.process(sample, 0));
    sample.record = c.params;
    made = pipeline.process(sample, 0);
    messages_.make(made);
  }
  const CameraMessages* operator->() const { return &messages_; }

  bridge::CameraUpdate made;

 private:
  CameraMessages messages_;
};

/// What a sink's outlet writes.
struct Sent {
  wire::CameraConstants constants;
  wire::CameraParams params;
};

std::optional<Sent> sent(const Case& c, const std::optional<bridge::OutgoingSet>& set) {
  if (!set || !set->constants) return std::nullopt;
  test::SinkControl control;
  control.open();
  bridge::OutletWriter outlet(std::make_unique<test::ControlledSink>(control, "sink"), form_of(c),
                              bridge::Feed::one_camera);
  outlet.write(*set->constants);
  outlet.write(set->params);
  if (control.constants().empty() || control.params().empty()) return std::nullopt;
  return Sent{control.constants()[0], control.params()[0]};
}

std::optional<Sent> sent_again(const Case& c, const Incoming& incoming) {
  bridge::ParamsToTrk outgoing;
  outgoing.use(from_msg(*incoming->constants()));
  return sent(c, outgoing.use(from_msg(*incoming->params()), 0));
}

void expect_same_through_params(const Case& c, std::uint32_t published_format) {
  const Incoming incoming(c, published_format);
  ASSERT_TRUE(incoming.made.params);
  const auto made = sent_again(c, incoming);
  ASSERT_TRUE(made);
  EXPECT_EQ(wire::format_to_words(made->params.format), wire::format_to_words(c.params.format));
  EXPECT_EQ(made->params.counter, c.params.counter);
  EXPECT_EQ(made->params.id, c.params.id);
  const auto camera = camera::decode(made->params, &made->constants);
  ASSERT_TRUE(camera);
  EXPECT_TRUE(test::same_to_the_digits(*camera, c.camera));
}

void expect_same_through_tf(const Case& c) {
  const Incoming incoming(c, wire::euler);
  ASSERT_TRUE(incoming.made.pose);
  ASSERT_TRUE(incoming.made.calibration);
  bridge::TfToTrkOptions options;
  options.chip.chip_width = c.constants.chip_width;
  options.chip.chip_height = c.constants.chip_height;
  options.chip.blank_left = c.constants.blank_left;
  options.chip.blank_right = c.constants.blank_right;
  options.chip.blank_top = c.constants.blank_top;
  options.chip.blank_bottom = c.constants.blank_bottom;
  bridge::TfToTrk outgoing(options);
  outgoing.use(from_msg(*incoming->camera_info()), today, 0);
  const auto made = sent(c, outgoing.make(to_isometry(incoming->transform().transform), today, 0));
  ASSERT_TRUE(made);
  EXPECT_EQ(wire::format_to_words(made->params.format), wire::format_to_words(c.params.format));
  const auto camera = camera::decode(made->params, &made->constants);
  ASSERT_TRUE(camera);
  EXPECT_TRUE(test::same_to_the_eye(*camera, c.camera, c.constants));
}

std::vector<Case> worked() {
  std::vector<Case> cases;
  for (const auto& one : test::worked_cases()) cases.push_back({one.params, one.constants, one.camera});
  return cases;
}

/// Cameras whose lens has a picture: up to 10 % of barrel or pincushion distortion by each of k1 and k2.
class RandomCases {
 public:
  Case next() {
    Case c;
    c.camera = random_.camera();
    c.constants = random_.constants();
    const double reach = camera::image_reach(c.camera.lens, camera::raster_of(c.constants));
    c.camera.lens.k1 = random_.between(-0.1, 0.1) / (reach * reach);
    c.camera.lens.k2 = random_.between(-0.1, 0.1) / (reach * reach * reach * reach);
    const auto& masks = masks_;
    const std::uint32_t format = masks[made_ % masks.size()];
    c.constants = camera::constants_for(c.constants, format);
    c.params = camera::encode(c.camera, format, &c.constants).value();
    c.params.counter = ++made_;
    return c;
  }

 private:
  test::RandomCameras random_;
  const std::vector<std::uint32_t> masks_ = test::meaningful_masks();
  std::uint64_t made_ = 0;
};

constexpr int random_count = 10'000;

TEST(RoundTrip, EveryWorkedCaseThroughParams) {
  for (const auto& c : worked()) {
    SCOPED_TRACE(wire::format_to_words(c.params.format));
    ASSERT_NO_FATAL_FAILURE(expect_same_through_params(c, wire::euler));
    ASSERT_NO_FATAL_FAILURE(expect_same_through_params(c, other_format));
  }
}

TEST(RoundTrip, EveryWorkedCaseThroughTfAndCameraInfo) {
  for (const auto& c : worked()) {
    SCOPED_TRACE(wire::format_to_words(c.params.format));
    ASSERT_NO_FATAL_FAILURE(expect_same_through_tf(c));
  }
}

TEST(RoundTrip, AsReceivedIsExactlyTheSameRecord) {
  for (const auto& c : worked()) {
    const Incoming incoming(c, std::nullopt);
    const auto made = sent_again(c, incoming);
    ASSERT_TRUE(made);
    // Words do not contain options without effect, such as the axes of a matrix that is not included.
    auto wanted = c.params;
    wanted.format = made->params.format;
    EXPECT_EQ(made->params, wanted);
  }
}

TEST(RoundTrip, RandomCamerasThroughParams) {
  RandomCases random;
  for (int i = 0; i < random_count && !HasFailure(); ++i) {
    const auto c = random.next();
    SCOPED_TRACE(i);
    ASSERT_NO_FATAL_FAILURE(expect_same_through_params(c, wire::euler));
  }
}

TEST(RoundTrip, RandomCamerasThroughTfAndCameraInfo) {
  RandomCases random;
  for (int i = 0; i < random_count && !HasFailure(); ++i) {
    const auto c = random.next();
    SCOPED_TRACE(i);
    ASSERT_NO_FATAL_FAILURE(expect_same_through_tf(c));
  }
}

}  // namespace trk_bridge::ros1::round_trip_test
