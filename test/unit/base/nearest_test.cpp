#include "base/nearest.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace trk_bridge::base {
namespace {

TEST(Nearest, IsTheSmallestEditDistance) {
  const std::vector<std::string> words{"delay", "source", "stamp", "format"};
  EXPECT_EQ(nearest("dely", words), "delay");
  EXPECT_EQ(nearest("sorce", words), "source");
  EXPECT_EQ(nearest("fromat", words), "format");
  EXPECT_EQ(nearest("stmp", words), "stamp");
}

TEST(Nearest, OfSeveralAtOneDistanceItIsTheFirst) {
  EXPECT_EQ(nearest("", {"bb", "aa"}), "bb");
  EXPECT_EQ(nearest("cat", {"bat", "hat"}), "bat");
}

}  // namespace
}  // namespace trk_bridge::base
