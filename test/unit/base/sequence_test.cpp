#include "trk_bridge/base/sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trk_bridge::base {
namespace {

TEST(Sequence, FirstThenNext) {
  Sequence sequence;
  EXPECT_EQ(sequence.judge(41), Order::first);
  EXPECT_EQ(sequence.judge(42), Order::next);
  EXPECT_EQ(sequence.judge(43), Order::next);
  EXPECT_EQ(sequence.counts().accepted, 3u);
  EXPECT_EQ(sequence.counts().lost, 0u);
}

TEST(Sequence, OnlyNewRecordsAreNews) {
  EXPECT_TRUE(is_new(Order::first));
  EXPECT_TRUE(is_new(Order::next));
  EXPECT_TRUE(is_new(Order::restarted));
  EXPECT_FALSE(is_new(Order::duplicate));
  EXPECT_FALSE(is_new(Order::late));
}

TEST(Sequence, CountsWhatIsMissing) {
  Sequence sequence;
  (void)sequence.judge(10);
  EXPECT_EQ(sequence.judge(14), Order::next);
  EXPECT_EQ(sequence.counts().lost, 3u);
  EXPECT_EQ(sequence.judge(15), Order::next);
  EXPECT_EQ(sequence.counts().lost, 3u);
}

TEST(Sequence, TheNewestAgainIsADuplicate) {
  Sequence sequence;
  (void)sequence.judge(10);
  EXPECT_EQ(sequence.judge(10), Order::duplicate);
  EXPECT_EQ(sequence.judge(10), Order::duplicate);
  EXPECT_EQ(sequence.counts().duplicates, 2u);
  EXPECT_EQ(sequence.counts().accepted, 1u);
}

TEST(Sequence, ALateRecordWasNotLost) {
  Sequence sequence;
  (void)sequence.judge(10);
  (void)sequence.judge(13);
  EXPECT_EQ(sequence.judge(11), Order::late);
  EXPECT_EQ(sequence.counts().lost, 1u);
  EXPECT_EQ(sequence.judge(11), Order::duplicate) << "the late one a second time";
  EXPECT_EQ(sequence.judge(10), Order::duplicate) << "an older one that came in its turn";
  EXPECT_EQ(sequence.judge(12), Order::late);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.counts().late, 2u);
  EXPECT_EQ(sequence.counts().duplicates, 2u);
  EXPECT_EQ(sequence.judge(14), Order::next);
}

TEST(Sequence, WhatIsOlderThanTheFirstWasNeverLost) {
  Sequence sequence;
  (void)sequence.judge(10);
  EXPECT_EQ(sequence.judge(9), Order::late);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.counts().late, 1u);
}

TEST(Sequence, BackByASecondIsLateAndMoreIsARestart) {
  Sequence sequence(50.0);
  (void)sequence.judge(1000);
  EXPECT_EQ(sequence.judge(950), Order::late);
  EXPECT_EQ(sequence.judge(949), Order::restarted);
  EXPECT_EQ(sequence.counts().restarts, 1u);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.judge(950), Order::next) << "counting goes on from where it restarted";
}

TEST(Sequence, AheadByAMinuteIsLossAndMoreIsARestart) {
  Sequence sequence(50.0);
  (void)sequence.judge(0);
  EXPECT_EQ(sequence.judge(3000), Order::next);
  EXPECT_EQ(sequence.counts().lost, 2999u);
  EXPECT_EQ(sequence.judge(6001), Order::restarted);
  EXPECT_EQ(sequence.counts().lost, 2999u);
  EXPECT_EQ(sequence.counts().restarts, 1u);
  EXPECT_EQ(sequence.counts().accepted, 3u);
}

TEST(Sequence, TheRateSetsWhatASecondIs) {
  Sequence sequence(240.0);
  (void)sequence.judge(1000);
  EXPECT_EQ(sequence.judge(760), Order::late);
  EXPECT_EQ(sequence.judge(759), Order::restarted);
  EXPECT_EQ(sequence.judge(759 + 240 * 60), Order::next);
  EXPECT_EQ(sequence.judge(759 + 240 * 120 + 1), Order::restarted);
}

TEST(Sequence, ARateThatIsNoneIsRefused) {
  EXPECT_THROW(Sequence(0.0), std::invalid_argument);
  EXPECT_THROW(Sequence(-50.0), std::invalid_argument);
  EXPECT_THROW(Sequence(std::nan("")), std::invalid_argument);
  EXPECT_THROW(Sequence(1e300), std::invalid_argument);
}

TEST(Sequence, AFourByteCounterWraps) {
  Sequence sequence;
  (void)sequence.judge(0xFFFFFFFDu);
  EXPECT_EQ(sequence.judge(0xFFFFFFFFu), Order::next);
  EXPECT_EQ(sequence.judge(1), Order::next);
  EXPECT_EQ(sequence.counts().lost, 2u);
  EXPECT_EQ(sequence.judge(0xFFFFFFFEu), Order::late) << "from before the wrap";
  EXPECT_EQ(sequence.judge(0), Order::late);
  EXPECT_EQ(sequence.judge(0xFFFFFFFFu), Order::duplicate);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.judge(2), Order::next);
}

TEST(Sequence, AnEightByteCounterDoesNotWrapAtFour) {
  Sequence sequence;
  (void)sequence.judge(0xFFFFFFFFu);
  EXPECT_EQ(sequence.judge(0x100000000u), Order::next);
  EXPECT_EQ(sequence.judge(0x100000001u), Order::next);
  EXPECT_EQ(sequence.judge(0xFFFFFFFEu), Order::late);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.judge(5), Order::restarted);
}

TEST(Sequence, TheLargestCountersAreNoTrouble) {
  Sequence sequence;
  (void)sequence.judge(0xFFFFFFFFFFFFFFFFu);
  EXPECT_EQ(sequence.judge(0xFFFFFFFFFFFFFFFFu), Order::duplicate);
  EXPECT_EQ(sequence.judge(0xFFFFFFFFFFFFFFFEu), Order::late);
  EXPECT_EQ(sequence.judge(0), Order::restarted);
  EXPECT_EQ(sequence.judge(0xFFFFFFFFFFFFFFFFu), Order::restarted);
}

TEST(Sequence, RemembersAsFarAsItsWindow) {
  Sequence sequence(1000.0);
  (void)sequence.judge(0);
  (void)sequence.judge(1000);
  ASSERT_EQ(sequence.counts().lost, 999u);
  EXPECT_EQ(sequence.judge(1000 - Sequence::window), Order::late);
  EXPECT_EQ(sequence.counts().lost, 998u);
  EXPECT_EQ(sequence.judge(1000 - Sequence::window), Order::duplicate);
  EXPECT_EQ(sequence.judge(1000 - Sequence::window - 1), Order::late);
  EXPECT_EQ(sequence.counts().lost, 998u) << "further back it cannot be told whether it came before";
}

TEST(Sequence, AJumpOfTheWholeWindowKeepsTheOneBefore) {
  Sequence sequence(1000.0);
  (void)sequence.judge(100);
  (void)sequence.judge(100 + Sequence::window);
  EXPECT_EQ(sequence.judge(100), Order::duplicate);
  EXPECT_EQ(sequence.judge(101), Order::late);
}

}  // namespace
}  // namespace trk_bridge::base
