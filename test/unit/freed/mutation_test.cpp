// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Damaged messages never become a wrong record.
#include <gmock/gmock.h>

#include <random>

#include "exact_copy.h"
#include "freed_messages.h"

namespace trk_bridge::freed::mutation_test {

TEST(FreeDMutation, TenThousandDamagedDatagrams) {
  const auto table = test::table_of("points: [{zoom: 0, focal_length: 8}, {zoom: 16000000, focal_length: 80}]");
  const std::string all[] = {test::worked_message(), test::extreme_message(), test::message_of(12, -3, 1)};
  std::mt19937 random(20261129);
  const auto below = [&random](std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
  };
  int lenient_only = 0;
  for (int i = 0; i < 10000; ++i) {
    std::string bad = all[below(std::size(all))];
    if (i % 4 == 0) {
      bad.resize(below(2 * message_size), '\0');
    } else {
      for (std::size_t n = 1 + below(4); n > 0; --n) {
        char& byte = bad[below(bad.size())];
        byte = static_cast<char>(byte ^ static_cast<char>(1 << below(8)));
      }
    }
    const test::ExactCopy copy(bad);
    ASSERT_EQ(test::broken_freed_claim(copy.view(), {}), "") << i;
    ASSERT_EQ(test::broken_freed_claim(copy.view(), {Profile::zcam, table, true}), "") << i;
    const auto message = read(copy.view());
    if (message && !message->checksum_fits) ++lenient_only;
  }
  EXPECT_GT(lenient_only, 5000) << "most damage is found by the checksum alone";
}

}  // namespace trk_bridge::freed::mutation_test
