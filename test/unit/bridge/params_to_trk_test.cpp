#include "bridge/params_to_trk.h"

#include <cmath>

#include <gmock/gmock.h>

#include "udp.h"

namespace trk_bridge::bridge {
namespace {

using test::constants;
using test::params;

TEST(ParamsToTrk, ParametersGoAsTheyCame) {
  ParamsToTrk input;
  const auto p = params(1000, 7);
  const auto set = input.take(p, 5);
  EXPECT_EQ(set.params, p);
  EXPECT_FALSE(set.constants) << "none are known";
  EXPECT_EQ(input.statistics().received, 1u);
  EXPECT_EQ(input.statistics().last_received, 5);
  EXPECT_EQ(input.statistics().last_format, p.format);
  EXPECT_FALSE(input.statistics().constants_known);
}

TEST(ParamsToTrk, ConstantsHaveTheIdOfTheParamsTheyGoWith) {
  ParamsToTrk input;
  input.take(constants(720, 3));
  EXPECT_EQ(input.take(params(1, 7), 0).constants, constants(720, 7));
  EXPECT_FALSE(input.take(params(2, 7), 0).constants) << "given before";
  EXPECT_EQ(input.take(params(3, 8), 0).constants, constants(720, 8));
  EXPECT_EQ(input.take(params(4, 7), 0).constants, constants(720, 7)) << "with the id, again";
}

TEST(ParamsToTrk, ChangedConstantsGoAgainUnchangedOnesDoNot) {
  ParamsToTrk input;
  input.take(constants());
  EXPECT_TRUE(input.take(params(1), 0).constants);
  input.take(constants());
  EXPECT_FALSE(input.take(params(2), 0).constants);
  auto other = constants();
  other.blank_left = 10;
  input.take(other);
  EXPECT_EQ(input.take(params(3), 0).constants, other);
}

TEST(ParamsToTrk, TheNewestConstantsCountWhateverTheirId) {
  ParamsToTrk input;
  input.take(constants(720, 7));
  input.take(constants(1920, 9));
  EXPECT_EQ(input.take(params(1, 7), 0).constants, constants(1920, 7));
}

TEST(ParamsToTrk, ConstantsOfTheParameterCountUntilOthersCome) {
  ParamsToTrk input(constants(1920));
  EXPECT_TRUE(input.statistics().constants_known);
  EXPECT_EQ(input.take(params(1), 0).constants->image_width, 1920);
  EXPECT_FALSE(input.statistics().constants_received);
  input.take(constants());
  EXPECT_EQ(input.take(params(2), 0).constants->image_width, 720);
  EXPECT_TRUE(input.statistics().constants_received);
}

TEST(ParamsToTrk, ConstantsWithoutAPictureAreIgnored) {
  ParamsToTrk input;
  auto bad = constants();
  bad.blank_left = 720;
  input.take(bad);
  EXPECT_FALSE(input.take(params(1), 0).constants);
  EXPECT_EQ(input.statistics().bad_constants, 1u);
  input.take(constants());
  input.take(bad);
  EXPECT_EQ(input.take(params(2), 0).constants, constants()) << "those before stay";
  EXPECT_EQ(input.statistics().bad_constants, 2u);
}

}  // namespace
}  // namespace trk_bridge::bridge
