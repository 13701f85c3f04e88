// One motion in three formats is one camera.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "file/take.h"
#include "trk_bridge/camera/camera.h"
#include "vectors.h"

namespace trk_bridge {
namespace {

camera::Camera camera_of(const file::Take& take, std::size_t field) {
  const auto decoded = camera::decode(take.params.at(field), &take.constants);
  if (!decoded) throw std::runtime_error("field " + std::to_string(field) + ": " + camera::describe(decoded.error()));
  return *decoded;
}

TEST(Takes, ThreeFormatsAreOneCamera) {
  const auto read = [](const std::string& name) {
    return file::read_take(test::data_path("field/takes/" + name + ".trk"));
  };
  const auto plain = read("euler");
  const auto angles = read("euler-ignore_blank-keep_aspect-field_of_view-vertical");
  const auto matrix = read("matrix-studio_to_camera-camera_y_up-studio_y_up");
  ASSERT_EQ(plain.params.size(), 2259u);
  for (const auto* other : {&angles, &matrix}) {
    ASSERT_EQ(other->params.size(), plain.params.size());
    for (std::size_t i = 0; i < plain.params.size(); ++i) {
      const camera::Camera expected = camera_of(plain, i), found = camera_of(*other, i);
      ASSERT_EQ(other->params[i].counter, plain.params[i].counter);
      // Six digits of metres up to 10, of angles up to 360 degrees, of millimetres.
      EXPECT_LT((expected.pose.translation() - found.pose.translation()).norm(), 2e-4) << i;
      EXPECT_LT((expected.pose.linear() - found.pose.linear()).norm(), 2e-5) << i;
      EXPECT_NEAR(found.lens.image_distance / expected.lens.image_distance, 1.0, 2e-5) << i;
      EXPECT_LT((expected.lens.center_shift - found.lens.center_shift).norm(), 2e-5) << i;
    }
  }
}

}  // namespace
}  // namespace trk_bridge
