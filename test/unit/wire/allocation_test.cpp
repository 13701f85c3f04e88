// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reading and writing a record allocates nothing.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "allocations.h"
#include "records.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire::allocation_test {

std::vector<std::string> samples() {
  test::RandomRecords random(1);
  std::vector<std::string> all;
  for (const std::uint32_t mask : {0x000U, 0x011U}) {
    all.push_back(test::encoded(random.params(mask), {Encoding::ascii, {}}));
    for (const Abi abi : {Abi::lp64, Abi::llp64, Abi::i386}) {
      for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
        const Layout layout{Generation::identified, abi, order};
        all.push_back(test::encoded(random.params(mask), {Encoding::binary, layout}));
        all.push_back(test::encoded(random.constants(), {Encoding::binary, layout}));
      }
    }
  }
  all.push_back(test::encoded(random.constants(), {Encoding::ascii, {}}));
  const std::string many_digits = "0." + std::string(1000, '0') + std::string(1000, '7');
  all.push_back(std::string("DMC01\0PA", 8) + "1 1 2 3 4 5 " + many_digits + " 1e-400 1e308 0 0 0 0 0 1");
  return all;
}

TEST(Allocation, NoneWhileReadingAndWriting) {
  const auto good = samples();
  auto bad = good;
  for (std::string& datagram : bad) datagram.resize(datagram.size() / 2);
  LayoutDetector detector;
  Buffer buffer;
  std::size_t read = 0, refused = 0;
  const auto allocated = test::allocations_of([&] {
    for (const std::string& datagram : good) {
      const auto decoded = decode(datagram, detector);
      if (!decoded) continue;
      ++read;
      for (const Encoding encoding : {Encoding::ascii, Encoding::binary}) {
        const WireForm form{encoding, decoded->form.layout};
        if (!std::visit([&](const auto& record) { return encode(record, form, buffer).has_value(); },
                        decoded->record)) {
          --read;
        }
      }
    }
    for (const std::string& datagram : bad) refused += decode(datagram, detector) ? 0U : 1U;
  });
  EXPECT_EQ(allocated, 0U);
  EXPECT_EQ(read, good.size());
  EXPECT_EQ(refused, bad.size());
}

}  // namespace trk_bridge::wire::allocation_test
