#include "ros/stamper.h"

#include <gmock/gmock.h>

namespace trk_bridge::ros1 {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t today = 1'700'000'000 * second + 123'456'789;

TEST(Stamper, IsArrivalLessDelayToTheNanosecond) {
  Stamper stamper(milliseconds(40));
  EXPECT_EQ(stamper.stamp(today), ::ros::Time(1'700'000'000, 83'456'789));
  EXPECT_EQ(stamper.stamp(today + 20'000'000), ::ros::Time(1'700'000'000, 103'456'789));
  EXPECT_EQ(stamper.held(), 0u);
}

TEST(Stamper, StrictlyIncreasesWhenTheClockStandsOrStepsBack) {
  Stamper stamper(nanoseconds(0));
  std::vector<::ros::Time> stamps;
  for (const std::int64_t offset : {0L, 0L, -3600 * second, -3599 * second, 1L, 2000L, second}) {
    const auto stamp = stamper.stamp(today + offset);
    ASSERT_TRUE(stamp);
    if (!stamps.empty()) {
      EXPECT_GT(*stamp, stamps.back());
      EXPECT_GT(stamp->toSec(), stamps.back().toSec()) << "must differ as doubles, too";
    }
    stamps.push_back(*stamp);
  }
  // Once the clock has caught up, stamps are the arrivals again.
  EXPECT_EQ(stamps.back(), ::ros::Time(1'700'000'001, 123'456'789));
  EXPECT_EQ(stamper.ahead(), 0);
  EXPECT_EQ(stamper.held(), 5u);
}

TEST(Stamper, TellsHowFarItIsAhead) {
  Stamper stamper(nanoseconds(0));
  ASSERT_TRUE(stamper.stamp(today));
  ASSERT_TRUE(stamper.stamp(today - 10 * second));
  EXPECT_EQ(stamper.ahead(), 10 * second + Stamper::least_step);
}

TEST(Stamper, RefusesWhatRosTimeCannotTellAndGoesOn) {
  Stamper stamper(milliseconds(5));
  EXPECT_FALSE(stamper.stamp(-1));
  EXPECT_FALSE(stamper.stamp(0));
  EXPECT_FALSE(stamper.stamp(4'000'000)) << "before 1970 once the delay is taken off";
  EXPECT_FALSE(stamper.stamp(std::numeric_limits<std::int64_t>::max()));
  EXPECT_FALSE(stamper.stamp(std::numeric_limits<std::int64_t>::min()));
  EXPECT_EQ(stamper.stamp(today), ::ros::Time(1'700'000'000, 118'456'789));
}

TEST(Stamper, EndsWithRosTime) {
  constexpr std::int64_t last = 4'294'967'295 * second + 999'999'999;
  Stamper stamper(nanoseconds(0));
  EXPECT_EQ(stamper.stamp(last), ::ros::Time(4'294'967'295u, 999'999'999u));
  EXPECT_FALSE(stamper.stamp(last)) << "nothing later can be told";
}

}  // namespace
}  // namespace trk_bridge::ros1
