// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera/least_squares.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace trk_bridge::camera::least_squares_test {

TEST(LeastSquares, FindsTheLineThroughPoints) {
  Terms terms(4, 2);
  Values wanted(4);
  terms << 0, 1, 1, 1, 2, 1, 3, 1;
  wanted << 1, 2, 2, 5;
  const Unknowns x = least_squares(terms, wanted);
  ASSERT_EQ(x.size(), 2);
  EXPECT_NEAR(x[0], 1.2, 1e-14);
  EXPECT_NEAR(x[1], 0.7, 1e-14);
}

TEST(LeastSquares, SolvesTheLargestSystem) {
  Terms terms(most_equations, most_unknowns);
  for (int i = 0; i < most_equations; ++i) {
    for (int j = 0; j < most_unknowns; ++j) terms(i, j) = std::pow((i + 0.5) / most_equations, j);
  }
  Unknowns expected(most_unknowns);
  expected << 1, -2, 3, -4, 5, -6;
  const Unknowns x = least_squares(terms, terms * expected);
  EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(LeastSquares, UsesOneOfDependentColumns) {
  Terms terms(3, 3);
  terms << 1, 2, 0, 1, 2, 1, 1, 2, 4;
  Values wanted(3);
  wanted << 4, 5, 8;
  const Unknowns x = least_squares(terms, wanted);
  EXPECT_EQ(x[0], 0);
  EXPECT_NEAR(x[1], 2, 1e-14);
  EXPECT_NEAR(x[2], 1, 1e-14);
}

TEST(LeastSquares, IsZeroWithoutTerms) { EXPECT_TRUE(least_squares(Terms::Zero(3, 2), Values::Ones(3)).isZero(0)); }

TEST(LeastSquares, EndsWithoutNumbers) {
  Terms terms = Terms::Ones(3, 2);
  terms(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(least_squares(terms, Values::Ones(3)).size(), 2);
}

}  // namespace trk_bridge::camera::least_squares_test
