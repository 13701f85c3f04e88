// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/params_to_trk.h"

#include <gmock/gmock.h>

#include "udp.h"

namespace trk_bridge::bridge::params_to_trk_test {

using test::constants;
using test::params;

TEST(ParamsToTrk, ParametersAreNotChanged) {
  ParamsToTrk input;
  const auto p = params(1000, 7);
  const auto set = input.use(p, 5);
  EXPECT_EQ(set.params, p);
  EXPECT_FALSE(set.constants) << "none are known";
  EXPECT_EQ(input.statistics().received, 1u);
  EXPECT_EQ(input.statistics().last_received, 5);
  EXPECT_EQ(input.statistics().last_format, p.format);
  EXPECT_EQ(input.statistics().constants, ConstantsOrigin::none);
}

TEST(ParamsToTrk, ConstantsHaveTheIdOfTheirParams) {
  ParamsToTrk input;
  input.use(constants(720, 3));
  EXPECT_EQ(input.use(params(1, 7), 0).constants, constants(720, 7));
  EXPECT_FALSE(input.use(params(2, 7), 0).constants) << "given before";
  EXPECT_EQ(input.use(params(3, 8), 0).constants, constants(720, 8));
  EXPECT_EQ(input.use(params(4, 7), 0).constants, constants(720, 7)) << "again with the id";
}

TEST(ParamsToTrk, ChangedConstantsAreSentAgainUnchangedOnesAreNot) {
  ParamsToTrk input;
  input.use(constants());
  EXPECT_TRUE(input.use(params(1), 0).constants);
  input.use(constants());
  EXPECT_FALSE(input.use(params(2), 0).constants);
  auto other = constants();
  other.blank_left = 10;
  input.use(other);
  EXPECT_EQ(input.use(params(3), 0).constants, other);
}

TEST(ParamsToTrk, TheNewestConstantsAreUsedWhateverTheirId) {
  ParamsToTrk input;
  input.use(constants(720, 7));
  input.use(constants(1920, 9));
  EXPECT_EQ(input.use(params(1, 7), 0).constants, constants(1920, 7));
}

TEST(ParamsToTrk, ConstantsOfTheParameterAreUsedUntilOthersArrive) {
  ParamsToTrk input(constants(1920));
  EXPECT_EQ(input.statistics().constants, ConstantsOrigin::parameter);
  EXPECT_EQ(input.use(params(1), 0).constants->image_width, 1920);
  EXPECT_EQ(input.statistics().constants, ConstantsOrigin::parameter);
  input.use(constants());
  EXPECT_EQ(input.use(params(2), 0).constants->image_width, 720);
  EXPECT_EQ(input.statistics().constants, ConstantsOrigin::own);
}

TEST(ParamsToTrk, InvalidConstantsAreIgnored) {
  ParamsToTrk input;
  auto bad = constants();
  bad.blank_left = 720;
  input.use(bad);
  EXPECT_FALSE(input.use(params(1), 0).constants);
  EXPECT_EQ(input.statistics().bad_constants, 1u);
  input.use(constants());
  input.use(bad);
  EXPECT_EQ(input.use(params(2), 0).constants, constants()) << "those before stay";
  EXPECT_EQ(input.statistics().bad_constants, 2u);
}

}  // namespace trk_bridge::bridge::params_to_trk_test
