// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor/axis_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::monitor::axis_check_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr PoseNumbers start{1, 2, 3, 178, 0, 0};

PoseNumbers moved(std::size_t number, double by) {
  auto pose = start;
  pose[number] += by;
  return pose;
}

TEST(AxisCheck, ReportsWhichAxisMovedAndItsSign) {
  AxisCheck check;
  EXPECT_THAT(check.lines(), IsEmpty());
  check.begin(start);
  EXPECT_THAT(check.lines(), ElementsAre("AXIS CHECK 1/6: pan left now"));
  check.look(moved(3, 4));
  EXPECT_THAT(check.lines(), SizeIs(1)) << "not far enough";
  // Through 180 degrees.
  auto turned = start;
  turned[3] = -176;
  check.look(turned);
  EXPECT_THAT(check.lines(), ElementsAre(HasSubstr("found; space"), "pan left: pan +6.00 deg: right"));
  check.look(moved(4, 80));
  EXPECT_THAT(check.lines()[1], "pan left: pan +6.00 deg: right") << "moving back is no movement";

  check.next(start);
  EXPECT_THAT(check.lines().front(), "AXIS CHECK 2/6: tilt up now (lens upwards)");
  check.look(moved(4, -7));
  EXPECT_EQ(check.lines()[1], "tilt up: tilt -7.00 deg: WRONG SIGN, tilt should grow");

  check.next(start);
  check.look(moved(3, 6));
  EXPECT_EQ(check.lines()[1], "roll clockwise: pan +6.00 deg: WRONG AXIS, roll should grow");

  check.next(start);
  auto both = moved(0, 0.2);
  both[1] -= 0.15;
  check.look(both);
  EXPECT_EQ(check.lines()[1], "move to the right wall: x +0.20 m: right; also y -0.15 m");

  check.next(start);
  check.next(start);
  check.next(start);
  EXPECT_THAT(check.lines(), SizeIs(7));
  EXPECT_EQ(check.lines()[0], "AXIS CHECK: all steps done");
  EXPECT_EQ(check.lines()[1], "move up: skipped");
  EXPECT_EQ(check.lines()[6], "pan left: pan +6.00 deg: right");
  check.end();
  EXPECT_FALSE(check.is_on());
}

TEST(AxisCheck, WithoutAPoseItSaysSo) {
  AxisCheck check;
  check.begin({});
  EXPECT_THAT(check.lines().front(), HasSubstr("no pose received"));
  check.look({});
  check.look(start);
  check.look(moved(3, 6));
  EXPECT_EQ(check.lines()[1], "pan left: pan +6.00 deg: right");
}

}  // namespace trk_bridge::monitor::axis_check_test
