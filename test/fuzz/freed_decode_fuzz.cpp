// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a datagram of Free-D: strictly, and leniently with a lens table.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "freed_messages.h"

namespace {

using namespace trk_bridge;

void claim(const std::string& broken) {
  if (broken.empty()) return;
  std::fprintf(stderr, "broken: %s\n", broken.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto table = test::table_of("points: [{zoom: 0, focal_length: 8}, {zoom: 100000, focal_length: 80}]");
  const std::string_view datagram(reinterpret_cast<const char*>(data), size);
  claim(test::broken_freed_claim(datagram, {}));
  claim(test::broken_freed_claim(datagram, {freed::Profile::vizrt, table, true}));
  claim(test::broken_freed_claim(datagram, {freed::Profile::zcam, nullptr, true}));
  return 0;
}
