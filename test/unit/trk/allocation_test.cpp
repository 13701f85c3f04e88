// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Receiving and sending records allocates nothing.
#include <gtest/gtest.h>

#include <string>

#include "allocations.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::trk::allocation_test {

using endpoints::open_sink;
using endpoints::open_source;
using transport::Event;
using transport::Reception;

void expect_no_allocation(const std::string& options) {
  const auto source = open_source("udp://127.0.0.1:0");
  const auto sink =
      open_sink("udp://127.0.0.1:" + std::to_string(test::port_of(*source)) + "?constants_period=1e-9" + options);
  ASSERT_TRUE(sink->write(test::constants(720, 1)));
  const test::PlainSocket stranger;
  const std::uint16_t port = test::port_of(*source);
  base::Sequence sequence;
  Reception reception;
  std::uint64_t samples = 0, malformed = 0;
  auto params = test::params(0, 1);
  const std::uint64_t during = test::allocations_of([&] {
    for (; params.counter < 100; ++params.counter) {
      if (!sink->write(params)) break;
      stranger.send("garbage", "127.0.0.1", port);
      for (Event event; (event = source->receive(reception, std::chrono::nanoseconds::zero())) != Event::idle;) {
        ++(event == Event::sample ? samples : malformed);
      }
      (void)sequence.classify(params.counter);
    }
  });
  EXPECT_EQ(samples, 201u) << "constants go with every set";
  EXPECT_EQ(malformed, 100u);
  EXPECT_EQ(during, 0u);
}

TEST(Allocation, NoneForAsciiRecords) { expect_no_allocation(""); }
TEST(Allocation, NoneForBinaryRecords) { expect_no_allocation("&binary=1"); }

}  // namespace trk_bridge::trk::allocation_test
