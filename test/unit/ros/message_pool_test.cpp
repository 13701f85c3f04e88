// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros/message_pool.h"

#include <gmock/gmock.h>
#include <trk_bridge/CameraParams.h>

#include <set>
#include <vector>

namespace trk_bridge::ros1::message_pool_test {

using Params = trk_bridge::CameraParams;
using Pool = MessagePool<Params>;

TEST(MessagePool, AMessageThatASubscriberKeepsIsNotReused) {
  Pool pool(in_frame<Params>("studio"));
  std::vector<boost::shared_ptr<const Params>> kept;
  for (std::uint64_t counter = 0; counter < 5 * Pool::size; ++counter) {
    pool.renew().counter = counter;
    kept.push_back(pool.current());
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i]->counter, i);
    EXPECT_EQ(kept[i]->header.frame_id, "studio");
  }
}

TEST(MessagePool, AMessageThatNoSubscriberKeepsIsReused) {
  Pool pool{Params()};
  std::set<const Params*> different;
  for (std::size_t i = 0; i < 10 * Pool::size; ++i) different.insert(&pool.renew());
  EXPECT_EQ(different.size(), Pool::size);
}

TEST(MessagePool, AMessageThatIsKeptForLongDoesNotAffectOthers) {
  Pool pool{Params()};
  pool.renew().counter = 7;
  const boost::shared_ptr<const Params> kept = pool.current();
  std::set<const Params*> different;
  for (std::size_t i = 0; i < 10 * Pool::size; ++i) different.insert(&pool.renew());
  EXPECT_EQ(different.size(), Pool::size);
  EXPECT_EQ(different.count(kept.get()), 0u);
  EXPECT_EQ(kept->counter, 7u);
}

TEST(MessagePool, TheCurrentOneIsThatOfTheLastRenewal) {
  Pool pool(in_frame<Params>("studio"));
  EXPECT_EQ(pool.current()->header.frame_id, "studio");
  Params& message = pool.renew();
  EXPECT_EQ(pool.current().get(), &message);
}

}  // namespace trk_bridge::ros1::message_pool_test
