// What runs for every sample allocates nothing.
#include <gmock/gmock.h>

#include <limits>

#include "allocations.h"
#include "bridge/camera_info.h"
#include "bridge/camera_pipeline.h"

namespace trk_bridge::bridge {
namespace {

using test::allocations_of;

wire::CameraConstants constants() { return {0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39}; }

TEST(Allocation, DoesNotHappenForSamples) {
  CameraOptions options;
  options.format = wire::euler | wire::field_of_view;
  CameraPipeline pipeline(options, 50);
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
      // Mild lenses for plumb_bob and strong ones for rational_polynomial; what comes twice; what is no camera.
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

}  // namespace
}  // namespace trk_bridge::bridge
