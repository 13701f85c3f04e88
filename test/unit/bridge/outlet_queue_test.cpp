// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/outlet_queue.h"

#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "bridge/outlet_writer.h"
#include "udp.h"

namespace trk_bridge::bridge::outlet_queue_test {

using test::constants;
using test::params;
using testing::ElementsAre;
using wire::Record;

std::vector<Record> all_of(OutletQueue& queue) {
  queue.close();
  std::vector<Record> records;
  while (const auto queued = queue.pop()) records.push_back(queued->record);
  return records;
}

TEST(OutletQueue, KeepsTheOrderOfAllRecords) {
  OutletQueue queue(4, WhenFull::fail);
  EXPECT_EQ(queue.push(params(1)), Pushed::queued);
  EXPECT_EQ(queue.push(constants(720)), Pushed::queued);
  EXPECT_EQ(queue.push(params(2)), Pushed::queued);
  EXPECT_EQ(queue.push(constants(1920)), Pushed::queued);
  EXPECT_EQ(queue.statistics().queued, 4u);
  EXPECT_THAT(all_of(queue), ElementsAre(params(1), constants(720), params(2), constants(1920)));
  EXPECT_EQ(queue.statistics().queued, 0u);
  EXPECT_EQ(queue.statistics().drops, 0u);
}

TEST(OutletQueue, AFullQueueDropsTheOldestParameters) {
  OutletQueue queue(3, WhenFull::drop_oldest);
  for (std::uint64_t counter = 1; counter <= 3; ++counter) EXPECT_EQ(queue.push(params(counter)), Pushed::queued);
  EXPECT_EQ(queue.push(params(4)), Pushed::made_room);
  EXPECT_EQ(queue.push(params(5)), Pushed::made_room);
  EXPECT_EQ(queue.statistics().drops, 2u);
  EXPECT_FALSE(queue.statistics().failed);
  EXPECT_THAT(all_of(queue), ElementsAre(params(3), params(4), params(5)));
}

TEST(OutletQueue, ConstantsOutliveLaterParameters) {
  OutletQueue queue(2, WhenFull::drop_oldest);
  EXPECT_EQ(queue.push(constants(720)), Pushed::queued);
  EXPECT_EQ(queue.push(params(1)), Pushed::queued);
  EXPECT_EQ(queue.push(params(2)), Pushed::queued) << "constants are kept elsewhere, so there is room";
  EXPECT_EQ(queue.push(params(3)), Pushed::made_room);
  EXPECT_EQ(queue.push(params(4)), Pushed::made_room);
  EXPECT_THAT(all_of(queue), ElementsAre(constants(720), params(3), params(4)));
}

TEST(OutletQueue, TheNewestConstantsOfEveryIdAreKept) {
  OutletQueue queue(1, WhenFull::drop_oldest);
  for (const auto& record : {constants(1, 7), constants(2, 8), constants(3, 7), constants(4, 7)}) {
    EXPECT_EQ(queue.push(record), Pushed::queued);
  }
  EXPECT_EQ(queue.push(params(1)), Pushed::queued);
  EXPECT_EQ(queue.push(params(2)), Pushed::made_room);
  EXPECT_THAT(all_of(queue), ElementsAre(constants(2, 8), constants(4, 7), params(2)));
}

TEST(OutletQueue, KeptConstantsStayInOrderOfArrival) {
  OutletQueue queue(1, WhenFull::drop_oldest);
  for (const auto& record : {constants(1, 7), constants(2, 8), constants(3, 7), constants(4, 9), constants(5, 8)}) {
    EXPECT_EQ(queue.push(record), Pushed::queued);
  }
  EXPECT_EQ(queue.push(params(1)), Pushed::queued);
  EXPECT_THAT(all_of(queue), ElementsAre(constants(3, 7), constants(4, 9), constants(5, 8), params(1)));
}

TEST(OutletQueue, ConstantsOfTooManyIdsAreLostAndReported) {
  OutletQueue queue(1, WhenFull::drop_oldest);
  for (std::uint32_t id = 0; id < OutletWriter::most_ids + 3; ++id) {
    EXPECT_EQ(queue.push(constants(720, id)), id <= OutletWriter::most_ids ? Pushed::queued : Pushed::lost_constants);
  }
  EXPECT_EQ(queue.statistics().drops, 2u) << "all but those that are kept and the one in the queue";
  EXPECT_EQ(all_of(queue).size(), OutletWriter::most_ids + 1);
}

TEST(OutletQueue, AQueueThatMustNotDropFailsPermanently) {
  OutletQueue queue(2, WhenFull::fail);
  EXPECT_EQ(queue.push(params(1)), Pushed::queued);
  EXPECT_EQ(queue.push(params(2)), Pushed::queued);
  EXPECT_EQ(queue.push(params(3)), Pushed::refused);
  EXPECT_EQ(queue.pop()->record, Record(params(1)));
  EXPECT_EQ(queue.push(params(4)), Pushed::refused) << "there is room, but a part is missing";
  EXPECT_TRUE(queue.statistics().failed);
  EXPECT_EQ(queue.statistics().drops, 2u);
  EXPECT_THAT(all_of(queue), ElementsAre(params(2)));
}

TEST(OutletQueue, PushWaitsForRoomIfItMay) {
  OutletQueue queue(2, WhenFull::wait);
  constexpr std::uint64_t count = 1000;
  std::thread pusher([&queue] {
    for (std::uint64_t counter = 1; counter <= count; ++counter) EXPECT_EQ(queue.push(params(counter)), Pushed::queued);
    queue.close();
  });
  std::uint64_t counter = 0;
  while (const auto queued = queue.pop()) {
    EXPECT_LE(queue.statistics().queued, 2u);
    EXPECT_EQ(queued->record, Record(params(++counter)));
  }
  pusher.join();
  EXPECT_EQ(counter, count);
  EXPECT_EQ(queue.statistics().drops, 0u);
}

TEST(OutletQueue, PushStopsWaitingIfItMayNotWaitAnyMore) {
  std::atomic<bool> may_wait{true};
  OutletQueue queue(1, WhenFull::wait, [&may_wait] { return may_wait.load(); });
  EXPECT_EQ(queue.push(params(1)), Pushed::queued);
  auto pushed = std::async(std::launch::async, [&queue] { return queue.push(params(2)); });
  EXPECT_EQ(pushed.wait_for(std::chrono::milliseconds(200)), std::future_status::timeout);
  may_wait = false;
  ASSERT_EQ(pushed.wait_for(test::deadline), std::future_status::ready);
  EXPECT_EQ(pushed.get(), Pushed::refused);
  EXPECT_EQ(queue.statistics().drops, 1u);
}

TEST(OutletQueue, RecordsKeepTheirTime) {
  OutletQueue queue(2, WhenFull::fail);
  ASSERT_EQ(queue.push(params(1), 1234), Pushed::queued);
  EXPECT_EQ(queue.pop()->time.nanoseconds, 1234);
}

TEST(OutletQueue, APopThatTimesOutReturnsNoneAndIsNotTheEnd) {
  OutletQueue queue(2, WhenFull::fail);
  EXPECT_FALSE(queue.pop(std::chrono::milliseconds(10)));
  EXPECT_FALSE(queue.is_over());
  ASSERT_EQ(queue.push(params(1)), Pushed::queued);
  queue.close();
  EXPECT_FALSE(queue.is_over()) << "one is left";
  EXPECT_TRUE(queue.pop(std::chrono::milliseconds(10)));
  EXPECT_TRUE(queue.is_over());
}

TEST(OutletQueue, AClosedQueueAcceptsNothing) {
  OutletQueue queue(2, WhenFull::wait);
  queue.close();
  EXPECT_EQ(queue.push(params(1)), Pushed::refused);
  EXPECT_FALSE(queue.pop());
}

TEST(OutletQueue, ClosingWakesAWaitingPop) {
  OutletQueue queue(2, WhenFull::fail);
  auto popped = std::async(std::launch::async, [&queue] { return queue.pop().has_value(); });
  queue.close();
  ASSERT_EQ(popped.wait_for(test::deadline), std::future_status::ready);
  EXPECT_FALSE(popped.get());
}

}  // namespace trk_bridge::bridge::outlet_queue_test
