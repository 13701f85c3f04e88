// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What is received while nothing is drawn.
#include "rviz/samples.h"

#include <thread>

#include <gmock/gmock.h>
#include <sensor_msgs/CameraInfo.h>
#include <boost/make_shared.hpp>

namespace trk_bridge::rviz_display::inbox_test {

using sensor_msgs::CameraInfo;

boost::shared_ptr<const CameraInfo> info(std::uint32_t mark) {
  const auto message = boost::make_shared<CameraInfo>();
  message->width = mark;
  return message;
}

TEST(Inbox, GivesEverythingOnceInOrder) {
  Inbox<CameraInfo> inbox;
  inbox.put(info(1), ros::Time(10));
  inbox.put(info(2), ros::Time(11));
  const auto arrivals = inbox.collect();
  ASSERT_EQ(arrivals.messages.size(), 2u);
  EXPECT_EQ(arrivals.messages[0]->width, 1u);
  EXPECT_EQ(arrivals.messages[1]->width, 2u);
  EXPECT_EQ(arrivals.count, 2u);
  EXPECT_EQ(arrivals.last, ros::Time(11));
  EXPECT_EQ(inbox.collect().count, 0u);
}

TEST(Inbox, DropsTheOldestButCountsThem) {
  Inbox<CameraInfo> inbox;
  for (std::uint32_t i = 0; i < 10000; ++i) inbox.put(info(i), ros::Time(10));
  const auto arrivals = inbox.collect();
  EXPECT_LE(arrivals.messages.size(), Inbox<CameraInfo>::most);
  EXPECT_GE(arrivals.messages.size(), Inbox<CameraInfo>::most / 2);
  EXPECT_EQ(arrivals.messages.back()->width, 9999u);
  EXPECT_EQ(arrivals.count, 10000u);
}

TEST(Inbox, LosesNothingBetweenThreads) {
  constexpr std::uint64_t sent = 20000;
  Inbox<CameraInfo> inbox;
  const auto message = info(1);
  std::thread sender([&] {
    for (std::uint64_t i = 0; i < sent; ++i) inbox.put(message, ros::Time(10));
  });
  std::uint64_t counted = 0;
  while (counted < sent) counted += inbox.collect().count;
  sender.join();
  EXPECT_EQ(counted, sent);
  EXPECT_EQ(inbox.collect().count, 0u);
}

}  // namespace trk_bridge::rviz_display::inbox_test
