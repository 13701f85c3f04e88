// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The code that runs for every sample allocates nothing.
#include <gmock/gmock.h>

#include "allocations.h"
#include "camera/figure.h"
#include "random_cameras.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/converter.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::camera::allocation_test {

using test::allocations_of;

TEST(Allocation, DoesNotHappenForSamples) {
  test::RandomCameras random;
  const auto masks = test::meaningful_masks();
  const wire::CameraConstants constants = random.constants();
  bool all_good = true;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const Camera camera = random.camera();
    count += allocations_of([&] {
      const auto params = encode(camera, masks[i], &constants);
      const auto back = params ? decode(*params, &constants) : tl::unexpected(params.error());
      Converter converter(masks[masks.size() - 1 - i]);
      all_good = all_good && converter.use(constants) == ConstantsChange::changed;
      const auto converted = params ? converter.convert(*params).params : params;
      const auto encoded = converter.convert(camera);
      const auto refused = encode(camera, 0x400, &constants);
      all_good = all_good && back && converted && encoded && !refused;
    });
  }
  EXPECT_TRUE(all_good);
  EXPECT_EQ(count, 0U);
}

TEST(Allocation, DoesNotHappenForCalibrations) {
  const wire::CameraConstants constants{0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 0, 0};
  Calibrator calibrator;
  bool all_good = true;
  const std::uint64_t count = allocations_of([&] {
    for (int i = 0; i < 20; ++i) {
      // Every second sample has a new lens: mild ones for plumb_bob and strong ones for rational_polynomial.
      const Lens lens{8, {0.1, 0.1}, -1e-4 * (i / 2), -3e-6 * (i / 2), 0, 0};
      all_good = all_good && calibrator.calibrate(lens, constants) && distort(lens, {1, 1});
    }
  });
  EXPECT_TRUE(all_good);
  EXPECT_EQ(calibrator.fits(), 10U);
  EXPECT_EQ(count, 0U);
}

TEST(Allocation, DoesNotHappenForBorders) {
  const ViewingLens lens{{1500, 0, 959.5, 0, 1500, 539.5, 0, 0, 1}, {-0.1, 0.01, 1e-3, -1e-3, 0}, 1920, 1080};
  bool good = false;
  EXPECT_EQ(allocations_of([&] { good = image_border(lens).has_value(); }), 0U);
  EXPECT_TRUE(good);
}

}  // namespace trk_bridge::camera::allocation_test
