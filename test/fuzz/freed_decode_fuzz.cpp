// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a datagram of Free-D: strictly, and leniently with a lens table.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "freed_messages.h"
#include "fuzz.h"

using namespace trk_bridge;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto table = test::table_of("points: [{zoom: 0, focal_length: 8}, {zoom: 100000, focal_length: 80}]");
  const std::string_view datagram(reinterpret_cast<const char*>(data), size);
  test::claim(test::broken_freed_claim(datagram, {}));
  test::claim(test::broken_freed_claim(datagram, {freed::Profile::vizrt, table, true}));
  test::claim(test::broken_freed_claim(datagram, {freed::Profile::zcam, nullptr, true}));
  return 0;
}
