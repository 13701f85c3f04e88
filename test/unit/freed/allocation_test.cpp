// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Receiving and sending records allocates nothing.
#include "allocations.h"
#include "camera_records.h"
#include "freed/encoder.h"
#include "freed_messages.h"

namespace trk_bridge::freed::allocation_test {

TEST(Allocation, NoneForMessages) {
  const auto table = test::table_of(
      "constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}\n"
      "points: [{zoom: 0, focal_length: 8}, {zoom: 50, focal_length: 30}, {zoom: 100, focal_length: 80}]\n"
      "focus: [{count: 0, distance: 1}, {count: 1000, distance: 9}]\n");
  Encoder encoder({Profile::generic, table, true});
  Decoder decoder({Profile::generic, table, false});
  ASSERT_TRUE(encoder.begin(test::constants(720, 7)));
  transport::Sample sample;
  transport::Fault fault;
  int samples = 0, faults = 0;
  const auto during = test::allocations_of([&] {
    for (std::uint64_t i = 0; i < 100; ++i) {
      if (!encoder.begin(test::params(i, 7))) return;
      while (const auto datagram = encoder.next()) {
        for (const std::string_view one : {*datagram, std::string_view("garbage")}) {
          decoder.begin(one, {});
          for (transport::Decoder::Next next; (next = decoder.next(sample, fault)) != transport::Decoder::Next::none;) {
            ++(next == transport::Decoder::Next::sample ? samples : faults);
          }
        }
      }
    }
  });
  EXPECT_EQ(samples, 102) << "with constants twice";
  EXPECT_EQ(faults, 100);
  EXPECT_EQ(during, 0u);
}

}  // namespace trk_bridge::freed::allocation_test
