// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The code that runs for every sample allocates nothing.
#include <gmock/gmock.h>

#include <limits>
#include <memory>

#include "allocations.h"
#include "bridge/camera_info.h"
#include "bridge/camera_pipeline.h"
#include "bridge/outlet_queue.h"
#include "bridge/outlet_writer.h"
#include "bridge/paced_camera.h"
#include "bridge/params_to_trk.h"
#include "bridge/tf_to_trk.h"

namespace trk_bridge::bridge::allocation_test {

using test::allocations_of;

/// Accepts everything and keeps nothing.
class NoSink final : public transport::Sink {
 public:
  std::string name() const override { return "nothing"; }

 private:
  transport::WriteResult put(const wire::CameraParams&) override { return {}; }
  transport::WriteResult put(const wire::CameraConstants&) override { return {}; }
  transport::WriteResult finish() override { return {}; }
};

OutletWriter writer_of(Feed feed) {
  transport::SinkForm form;
  form.format = wire::euler | wire::field_of_view;
  return {std::make_unique<NoSink>(), form, feed};
}

void write(OutletWriter& writer, const OutgoingSet& set) {
  if (set.constants) writer.write(*set.constants);
  writer.write(set.params);
}

wire::CameraConstants constants() { return {0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39}; }

TEST(Allocation, DoesNotHappenForSamples) {
  CameraOptions options;
  options.format = wire::euler | wire::field_of_view;
  options.stamp = StampMode::counter;
  CameraPipeline pipeline(options, std::nullopt);
  transport::Sample sample;
  wire::CameraParams params;
  params.format = wire::euler | wire::shift_in_pixels;
  params.fov = 10;
  params.center_x = 3;
  int whole = 0, poses = 0, dropped = 0;
  const std::uint64_t count = allocations_of([&] {
    for (int i = 0; i < 300; ++i) {
      sample.arrival = 1'700'000'000'000'000'000 + std::int64_t{i} * 20'000'000;
      auto sent = constants();
      sent.chip_width += 1e-3 * i;
      sample.record = sent;
      (void)pipeline.process(sample, i);
      // Mild lenses for plumb_bob and strong ones for rational_polynomial; duplicates; values that are no camera.
      params.k1 = -1e-5 * i;
      params.counter = static_cast<std::uint64_t>(i + i % 3);
      params.euler.pan = i % 7 == 6 ? std::numeric_limits<double>::infinity() : i;
      sample.has_lens = i % 5 != 4;
      sample.record = params;
      const auto update = pipeline.process(sample, i);
      if (update.params && update.calibration) ++whole;
      if (update.pose && !update.params) ++poses;
      if (!update.pose) ++dropped;
    }
  });
  EXPECT_GT(whole, 50);
  EXPECT_GT(poses, 10);
  EXPECT_GT(dropped, 10);
  EXPECT_EQ(count, 0U);
}

TEST(Allocation, DoesNotHappenForCameraInfosOfOneCalibration) {
  CameraInfo info;
  info.width = 1920;
  info.height = 1080;
  info.distortion_model = "rational_polynomial";
  info.d = {-0.1, 0.01, 0, 0, 0, 0, 0, 0};
  info.k = {1500, 0, 959.5, 0, 1500, 539.5, 0, 0, 1};
  const CameraInfo other = info;
  bool good = false;
  EXPECT_EQ(allocations_of([&] { good = same_calibration(info, other) && fit_lens(info, constants()); }), 0U);
  EXPECT_TRUE(good);
}

TEST(Allocation, DoesNotHappenForSetsOfTopics) {
  ParamsToTrk input;
  auto writer = writer_of(Feed::one_camera);
  wire::CameraParams params;
  params.format = wire::euler;
  params.fov = 10;
  const auto write_one = [&](int i) {
    auto sent = constants();
    sent.chip_width += 1e-3 * (i / 4);
    // Some lenses without a picture, and some poses that are no camera.
    if (i % 20 == 19) sent.image_width = 0;
    input.use(sent);
    params.id = static_cast<std::uint32_t>(i % 3);
    params.euler.pan = i % 7 == 6 ? std::numeric_limits<double>::infinity() : i;
    write(writer, input.use(params, i));
  };
  write_one(0);
  EXPECT_EQ(allocations_of([&] {
              for (int i = 1; i < 300; ++i) write_one(i);
            }),
            0U);
  EXPECT_GT(writer.statistics().sent.params, 200U);
  EXPECT_GT(writer.statistics().sent.constants, 200U);
  EXPECT_GT(writer.statistics().dropped, 10U);
  EXPECT_GT(input.statistics().bad_constants, 10U);
}

TEST(Allocation, DoesNotHappenForSetsOfTf) {
  TfToTrkOptions options;
  options.chip = constants();
  TfToTrk input(options);
  auto writer = writer_of(Feed::one_camera);
  CameraInfo info;
  info.width = 1920;
  info.height = 1080;
  info.distortion_model = "plumb_bob";
  info.d = {-0.1, 0.01, 0, 0, 0};
  info.k = {1500, 0, 959.5, 0, 1500, 539.5, 0, 0, 1};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto write_one = [&](int i) {
    const std::int64_t stamp = 1'700'000'000'000'000'000 + std::int64_t{i} * 20'000'000;
    input.use(info, stamp, i);
    input.use_lens(i, 2.8);
    pose.translation().x() = i % 7 == 6 ? std::numeric_limits<double>::infinity() : i;
    if (!input.is_new(stamp)) return;
    if (const auto set = input.make(pose, stamp, i)) write(writer, *set);
  };
  write_one(0);
  EXPECT_EQ(allocations_of([&] {
              for (int i = 1; i < 300; ++i) write_one(i);
            }),
            0U);
  EXPECT_GT(writer.statistics().sent.params, 200U);
  EXPECT_GT(input.statistics().dropped, 10U);
}

TEST(Allocation, DoesNotHappenForForwardedRecords) {
  auto writer = writer_of(Feed::passed_on);
  const auto write_all = [&](int round) {
    for (std::uint32_t id = 0; id < OutletWriter::most_ids + 3; ++id) {
      auto sent = constants();
      sent.id = id;
      sent.chip_width += 1e-3 * round;
      if (round == 2) sent.image_width = 0;
      writer.write(sent);
      wire::CameraParams params;
      params.id = id;
      params.format = wire::euler;
      params.fov = 10;
      writer.write(params);
    }
  };
  write_all(0);
  EXPECT_EQ(allocations_of([&] {
              for (int round = 1; round < 5; ++round) write_all(round);
            }),
            0U);
  EXPECT_EQ(writer.statistics().sent.constants, 4 * OutletWriter::most_ids);
  EXPECT_GT(writer.statistics().withheld, OutletWriter::most_ids);
}

TEST(Allocation, DoesNotHappenInAQueueThatIsFull) {
  OutletQueue queue(2, WhenFull::drop_oldest);
  EXPECT_EQ(allocations_of([&] {
              for (std::uint32_t i = 0; i < 2 * OutletWriter::most_ids; ++i) {
                auto sent = constants();
                sent.id = i;
                (void)queue.push(sent);
                (void)queue.push(wire::CameraParams{});
              }
            }),
            0U);
  EXPECT_GT(queue.statistics().queued, OutletWriter::most_ids);
}

TEST(Allocation, DoesNotHappenForSetsThatAreDelayed) {
  const OutputTiming third_of_a_field{{6'000'000, 7'000'000, 8'000'000}, 40'000'000};
  PacedCamera camera(50, {third_of_a_field, third_of_a_field});
  wire::CameraParams params;
  params.format = wire::euler | wire::field_of_view;
  params.fov = 40;
  int sent = 0;
  const std::uint64_t count = allocations_of([&] {
    for (int i = 0; i < 1000; ++i) {
      const std::int64_t now = 1'700'000'000'000'000'000 + std::int64_t{i} * 20'000'000;
      params.counter = static_cast<std::uint64_t>(i);
      params.euler.pan = i % 7 == 6 ? std::numeric_limits<double>::infinity() : i;
      (void)camera.add(params, now - i % 3 * 15'000'000, 0, now, now);
      if (!camera.due()) continue;
      camera.depart(*camera.due(), *camera.due());
      for (const std::size_t output : {0U, 1U}) sent += camera.take(output, now + 100'000, now + 100'000) ? 1 : 0;
    }
  });
  EXPECT_GT(sent, 1000);
  EXPECT_EQ(count, 0U);
}

}  // namespace trk_bridge::bridge::allocation_test
