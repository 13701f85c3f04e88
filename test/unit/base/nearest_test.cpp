// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "base/nearest.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace trk_bridge::base::nearest_test {

TEST(Nearest, IsTheSmallestEditDistance) {
  const std::vector<std::string> words{"delay", "source", "stamp", "format"};
  EXPECT_EQ(nearest("dely", words), "delay");
  EXPECT_EQ(nearest("sorce", words), "source");
  EXPECT_EQ(nearest("fromat", words), "format");
  EXPECT_EQ(nearest("stmp", words), "stamp");
}

TEST(Nearest, TheFirstOfSeveralAtEqualDistance) {
  EXPECT_EQ(nearest("", {"bb", "aa"}), "bb");
  EXPECT_EQ(nearest("cat", {"bat", "hat"}), "bat");
}

TEST(Likely, IsTheNearestIfItIsSimilar) {
  const std::vector<std::string> words{"udp", "freed", "dump", "monitor"};
  EXPECT_EQ(likely("upd", words), "udp");
  EXPECT_EQ(likely("dumb", words), "dump");
  EXPECT_EQ(likely("moniter", words), "monitor");
  EXPECT_EQ(likely("carrier_pigeon", words), std::nullopt);
  EXPECT_EQ(likely("", words), std::nullopt);
  EXPECT_EQ(likely("ab", {"cd"}), std::nullopt) << "all of it would be wrong";
  EXPECT_EQ(likely("udp", {}), std::nullopt);
}

}  // namespace trk_bridge::base::nearest_test
