// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Only the library that reads JSON and CBOR allocates, for long names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "allocations.h"
#include "packets.h"

namespace trk_bridge::opentrackio::allocation_test {

/// Allocations of a decoder for a datagram of a known sender; the samples and faults are counted in `given`.
std::uint64_t allocations_for(PacketDecoder& decoder, const std::string& datagram, int& given) {
  transport::Sample sample;
  transport::Fault fault;
  return test::allocations_of([&] {
    decoder.begin(datagram, {});
    while (decoder.next(sample, fault) != transport::Decoder::Next::none) ++given;
  });
}

TEST(Allocation, ForDatagramsThatAreNotRead) {
  PacketDecoder decoder(false, 37);
  const std::string good = test::packet_of(test::full_sample().dump());
  std::string broken = good;
  broken.back() = 'x';
  const std::string segment = test::packet_of("{", Encoding::json, 1, 0, false);
  int given = 0;
  (void)allocations_for(decoder, segment, given);
  (void)allocations_for(decoder, good, given);
  EXPECT_EQ(given, 3) << "the segment was lost, and two records were received";
  for (const std::string& datagram : {good, broken, broken.substr(0, 10), segment}) {
    EXPECT_EQ(allocations_for(decoder, datagram, given), 0U);
  }
  EXPECT_EQ(given, 5) << "a checksum and a header";
}

TEST(Allocation, OfASample) {
  for (const Encoding encoding : {Encoding::json, Encoding::cbor}) {
    PacketDecoder decoder(false, 37);
    int given = 0;
    std::uint64_t most = 0;
    for (unsigned i = 0; i < 20; ++i) {
      auto sample = test::full_sample();
      sample["timing"]["sequenceNumber"] = i;
      const std::vector<std::uint8_t> cbor = test::Json::to_cbor(sample);
      const std::string text = encoding == Encoding::json ? sample.dump() : std::string(cbor.begin(), cbor.end());
      const std::uint64_t count = allocations_for(decoder, test::packet_of(text, encoding, i), given);
      if (i > 0) most = std::max(most, count);
    }
    EXPECT_EQ(given, 40);
    RecordProperty(encoding == Encoding::json ? "json" : "cbor", static_cast<int>(most));
    // Names of more than 15 letters and the parser's own buffers; a tree of the sample would be more than a hundred.
    EXPECT_LE(most, 20U);
  }
}

}  // namespace trk_bridge::opentrackio::allocation_test
