// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/base/sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trk_bridge::base::sequence_test {

TEST(Sequence, FirstThenNext) {
  Sequence sequence;
  EXPECT_EQ(sequence.classify(41), Order::first);
  EXPECT_EQ(sequence.classify(42), Order::next);
  EXPECT_EQ(sequence.classify(43), Order::next);
  EXPECT_EQ(sequence.counts().accepted, 3u);
  EXPECT_EQ(sequence.counts().lost, 0u);
}

TEST(Sequence, IsNewForNewRecordsOnly) {
  EXPECT_TRUE(is_new(Order::first));
  EXPECT_TRUE(is_new(Order::next));
  EXPECT_TRUE(is_new(Order::restarted));
  EXPECT_TRUE(is_new(Order::uncounted));
  EXPECT_FALSE(is_new(Order::duplicate));
  EXPECT_FALSE(is_new(Order::late));
}

TEST(Sequence, ReportsTheStepFromTheNewestRecord) {
  Sequence sequence;
  const auto step_of = [&sequence](std::uint64_t counter) {
    (void)sequence.classify(counter);
    return sequence.step();
  };
  EXPECT_EQ(step_of(0xFFFD), 0u) << "the first";
  EXPECT_EQ(step_of(0xFFFE), 1u);
  EXPECT_EQ(step_of(0xFFFE), 0u) << "twice";
  EXPECT_EQ(step_of(1), 3u) << "16 bits";
  EXPECT_EQ(step_of(0), 0u) << "late";
  EXPECT_EQ(step_of(2), 1u);
  EXPECT_EQ(step_of(100000), 0u) << "restarted";
}

TEST(Sequence, AFieldRateThatBecomesKnownChangesTheLimitOfLoss) {
  Sequence sequence(50);
  (void)sequence.classify(1);
  EXPECT_EQ(sequence.classify(1 + 3001), Order::restarted) << "more than 60 s of 50 Hz";
  sequence.use_field_rate(100);
  EXPECT_EQ(sequence.classify(3002 + 3001), Order::next);
  sequence.use_field_rate(0);
  EXPECT_EQ(sequence.classify(6003 + 3001), Order::next) << "0 Hz is no rate";
}

TEST(Sequence, CountsWhatIsMissing) {
  Sequence sequence;
  (void)sequence.classify(10);
  EXPECT_EQ(sequence.classify(14), Order::next);
  EXPECT_EQ(sequence.counts().lost, 3u);
  EXPECT_EQ(sequence.classify(15), Order::next);
  EXPECT_EQ(sequence.counts().lost, 3u);
}

TEST(Sequence, ARepeatedNewestRecordIsADuplicate) {
  Sequence sequence;
  (void)sequence.classify(10);
  EXPECT_EQ(sequence.classify(10), Order::duplicate);
  EXPECT_EQ(sequence.classify(10), Order::duplicate);
  EXPECT_EQ(sequence.counts().duplicates, 2u);
  EXPECT_EQ(sequence.counts().accepted, 1u);
}

TEST(Sequence, ALateRecordWasNotLost) {
  Sequence sequence;
  (void)sequence.classify(10);
  (void)sequence.classify(13);
  EXPECT_EQ(sequence.classify(11), Order::late);
  EXPECT_EQ(sequence.counts().lost, 1u);
  EXPECT_EQ(sequence.classify(11), Order::duplicate) << "the late one a second time";
  EXPECT_EQ(sequence.classify(10), Order::duplicate) << "an older one that arrived in order";
  EXPECT_EQ(sequence.classify(12), Order::late);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.counts().late, 2u);
  EXPECT_EQ(sequence.counts().duplicates, 2u);
  EXPECT_EQ(sequence.classify(14), Order::next);
}

TEST(Sequence, RecordsOlderThanTheFirstAreNotCountedAsLost) {
  Sequence sequence;
  (void)sequence.classify(10);
  EXPECT_EQ(sequence.classify(9), Order::late);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.counts().late, 1u);
}

TEST(Sequence, BackByASecondIsLateAndMoreIsARestart) {
  Sequence sequence(50.0);
  (void)sequence.classify(1000);
  EXPECT_EQ(sequence.classify(950), Order::late);
  EXPECT_EQ(sequence.classify(949), Order::restarted);
  EXPECT_EQ(sequence.counts().restarts, 1u);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.classify(950), Order::next) << "counting continues from the restart";
}

TEST(Sequence, AheadByAMinuteIsLossAndMoreIsARestart) {
  Sequence sequence(50.0);
  (void)sequence.classify(0);
  EXPECT_EQ(sequence.classify(3000), Order::next);
  EXPECT_EQ(sequence.counts().lost, 2999u);
  EXPECT_EQ(sequence.classify(6001), Order::restarted);
  EXPECT_EQ(sequence.counts().lost, 2999u);
  EXPECT_EQ(sequence.counts().restarts, 1u);
  EXPECT_EQ(sequence.counts().accepted, 3u);
}

TEST(Sequence, TheRateSetsWhatASecondIs) {
  Sequence sequence(240.0);
  (void)sequence.classify(1000);
  EXPECT_EQ(sequence.classify(760), Order::late);
  EXPECT_EQ(sequence.classify(759), Order::restarted);
  EXPECT_EQ(sequence.classify(759 + 240 * 60), Order::next);
  EXPECT_EQ(sequence.classify(759 + 240 * 120 + 1), Order::restarted);
}

TEST(Sequence, AnInvalidRateIsRefused) {
  EXPECT_THROW(Sequence(0.0), std::invalid_argument);
  EXPECT_THROW(Sequence(-50.0), std::invalid_argument);
  EXPECT_THROW(Sequence(std::nan("")), std::invalid_argument);
  EXPECT_THROW(Sequence(1e300), std::invalid_argument);
}

TEST(Sequence, AFourByteCounterWraps) {
  Sequence sequence;
  (void)sequence.classify(0xFFFFFFFDu);
  EXPECT_EQ(sequence.classify(0xFFFFFFFFu), Order::next);
  EXPECT_EQ(sequence.classify(1), Order::next);
  EXPECT_EQ(sequence.counts().lost, 2u);
  EXPECT_EQ(sequence.classify(0xFFFFFFFEu), Order::late) << "from before the wrap";
  EXPECT_EQ(sequence.classify(0), Order::late);
  EXPECT_EQ(sequence.classify(0xFFFFFFFFu), Order::duplicate);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.classify(2), Order::next);
}

TEST(Sequence, AnEightByteCounterDoesNotWrapAtFour) {
  Sequence sequence;
  (void)sequence.classify(0xFFFFFFFFu);
  EXPECT_EQ(sequence.classify(0x100000000u), Order::next);
  EXPECT_EQ(sequence.classify(0x100000001u), Order::next);
  EXPECT_EQ(sequence.classify(0xFFFFFFFEu), Order::late);
  EXPECT_EQ(sequence.counts().lost, 0u);
  EXPECT_EQ(sequence.classify(5), Order::restarted);
}

TEST(Sequence, TheLargestCountersWork) {
  Sequence sequence;
  (void)sequence.classify(0xFFFFFFFFFFFFFFFFu);
  EXPECT_EQ(sequence.classify(0xFFFFFFFFFFFFFFFFu), Order::duplicate);
  EXPECT_EQ(sequence.classify(0xFFFFFFFFFFFFFFFEu), Order::late);
  EXPECT_EQ(sequence.classify(0), Order::next) << "it wraps";
  EXPECT_EQ(sequence.classify(0xFFFFFFFFFFFFFFFFu), Order::duplicate);
}

TEST(Sequence, RemembersItsWindow) {
  Sequence sequence(1000.0);
  (void)sequence.classify(0);
  (void)sequence.classify(1000);
  ASSERT_EQ(sequence.counts().lost, 999u);
  EXPECT_EQ(sequence.classify(1000 - Sequence::window), Order::late);
  EXPECT_EQ(sequence.counts().lost, 998u);
  EXPECT_EQ(sequence.classify(1000 - Sequence::window), Order::duplicate);
  EXPECT_EQ(sequence.classify(1000 - Sequence::window - 1), Order::late);
  EXPECT_EQ(sequence.counts().lost, 998u) << "further back it is not known whether it has arrived before";
}

TEST(Sequence, AJumpOfTheFullWindowKeepsTheRecordBefore) {
  Sequence sequence(1000.0);
  (void)sequence.classify(100);
  (void)sequence.classify(100 + Sequence::window);
  EXPECT_EQ(sequence.classify(100), Order::duplicate);
  EXPECT_EQ(sequence.classify(101), Order::late);
}

TEST(Sequence, CountersOfAnyWidthWrap) {
  for (const unsigned bits : {16U, 31U, 32U, 64U}) {
    const std::uint64_t top = bits == 64 ? 0 : std::uint64_t{1} << bits;
    for (const auto use : {CounterUse::strict, CounterUse::automatic}) {
      Sequence sequence(50.0, use);
      std::uint64_t fingerprint = 0;
      (void)sequence.classify(top - 3, ++fingerprint);
      EXPECT_EQ(sequence.classify(top - 1, ++fingerprint), Order::next);
      EXPECT_EQ(sequence.classify(1, ++fingerprint), Order::next) << bits;
      EXPECT_EQ(sequence.counts().lost, 2u);
      EXPECT_EQ(sequence.classify(top - 2, ++fingerprint), Order::late) << bits;
      EXPECT_EQ(sequence.classify(0, ++fingerprint), Order::late);
      EXPECT_EQ(sequence.counts().lost, 0u);
    }
  }
}

/// Judges records with different contents: equal counters alone do not mean equal records.
class Automatic : public ::testing::Test {
 protected:
  Order classify(std::uint64_t counter) { return sequence.classify(counter, ++fingerprint_); }
  /// A camera that does not move: records with equal counters are equal.
  Order classify_still(std::uint64_t counter) { return sequence.classify(counter, counter + 1'000'000); }

  Sequence sequence{50.0, CounterUse::automatic};

 private:
  std::uint64_t fingerprint_ = 0;
};

TEST_F(Automatic, ALateRecordFillsAGapOfAtMost16) {
  (void)classify(100);
  (void)classify(120);
  EXPECT_EQ(classify(104), Order::late);
  EXPECT_EQ(classify(103), Order::restarted) << "further back than late_reach";
  EXPECT_EQ(classify(104), Order::next);
  EXPECT_EQ(sequence.counts().late, 1u);
}

TEST_F(Automatic, EqualRecordsAreDuplicatesAndEqualCountersAreARestart) {
  (void)classify_still(10);
  (void)classify_still(11);
  EXPECT_EQ(classify_still(11), Order::duplicate);
  EXPECT_EQ(classify_still(10), Order::duplicate);
  EXPECT_EQ(classify(10), Order::restarted);
  EXPECT_EQ(classify(11), Order::next);
}

TEST_F(Automatic, ALateRecordThatComesTwiceIsADuplicate) {
  (void)classify_still(10);
  (void)classify_still(12);
  EXPECT_EQ(classify_still(11), Order::late);
  EXPECT_EQ(classify_still(11), Order::duplicate);
}

TEST_F(Automatic, ADuplicateOfTheLastSecondIsNotARestart) {
  for (std::uint64_t counter = 0; counter < 100; ++counter) (void)classify_still(counter);
  EXPECT_EQ(classify_still(50), Order::duplicate);
  EXPECT_EQ(classify_still(100), Order::next);
}

TEST_F(Automatic, ATakeThatIsPlayedAgainIsARestart) {
  for (int round = 0; round < 3; ++round) {
    for (std::uint64_t counter = 0; counter < 200; ++counter) EXPECT_TRUE(is_new(classify_still(counter)));
  }
  EXPECT_EQ(sequence.counts().restarts, 2u);
  EXPECT_EQ(sequence.counts().state, CounterState::counts);
}

TEST_F(Automatic, TooManyConsecutiveLateRecordsAreARestart) {
  (void)classify(10);
  (void)classify(24);
  for (std::uint64_t counter = 11; counter < 11 + Sequence::lates_allowed; ++counter) {
    EXPECT_EQ(classify(counter), Order::late);
  }
  EXPECT_EQ(classify(11 + Sequence::lates_allowed), Order::restarted);
  EXPECT_EQ(classify(12 + Sequence::lates_allowed), Order::next);
}

TEST_F(Automatic, DetectsACounterThatStandsStillAndCountsAgain) {
  EXPECT_EQ(classify_still(7), Order::first);
  for (unsigned i = 0; i < Sequence::repeats_allowed; ++i) EXPECT_EQ(classify_still(7), Order::duplicate);
  EXPECT_EQ(sequence.counts().state, CounterState::counts);
  EXPECT_EQ(classify_still(7), Order::uncounted) << "the fifth field";
  EXPECT_EQ(classify_still(7), Order::uncounted);
  EXPECT_EQ(sequence.counts().state, CounterState::frozen);
  for (std::uint64_t counter = 8; counter < 200; ++counter) EXPECT_EQ(classify_still(counter), Order::next);
  EXPECT_EQ(sequence.counts().state, CounterState::counts);
  EXPECT_EQ(classify_still(199), Order::duplicate);
}

TEST_F(Automatic, ACounterOfFramesAcceptsBothFields) {
  for (std::uint64_t i = 0; i < 20; ++i) EXPECT_TRUE(is_new(classify(i / 2))) << i;
  EXPECT_EQ(sequence.counts().state, CounterState::frozen);
  EXPECT_EQ(sequence.counts().lost, 0u);
}

TEST_F(Automatic, OneRestartIsNotACycle) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    EXPECT_TRUE(is_new(classify(i < 40 ? i : i - 40))) << i;
    EXPECT_EQ(sequence.counts().state, CounterState::counts);
  }
  EXPECT_EQ(sequence.counts().restarts, 1u);
}

TEST_F(Automatic, AShortCycleIsDetected) {
  for (std::uint64_t i = 0; i < 100; ++i) EXPECT_TRUE(is_new(classify(i % 30))) << i;
  EXPECT_EQ(sequence.counts().state, CounterState::cycles);
  EXPECT_EQ(sequence.counts().lost, 0u);
}

TEST_F(Automatic, AnotherSenderBegins) {
  (void)classify(1000);
  sequence.forget_newest();
  EXPECT_EQ(classify(995), Order::first);
  EXPECT_EQ(classify(996), Order::next);
  EXPECT_EQ(sequence.counts().lost, 0u);
}

TEST(Sequence, IgnoredCountersHaveNoEffect) {
  Sequence sequence(50.0, CounterUse::ignore);
  for (const std::uint64_t counter : {5u, 5u, 3u, 900u, 5u}) EXPECT_EQ(sequence.classify(counter), Order::uncounted);
  EXPECT_EQ(sequence.counts().accepted, 5u);
  EXPECT_EQ(sequence.counts().lost + sequence.counts().duplicates + sequence.counts().restarts, 0u);
}

}  // namespace trk_bridge::base::sequence_test
