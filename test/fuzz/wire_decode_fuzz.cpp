// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a datagram: with nothing known of the sender, with its layout given, and twice.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "codec_claims.h"
#include "fuzz.h"
#include "trk_bridge/wire/codec.h"

namespace {

using namespace trk_bridge;

void claim_with_given_layout(std::string_view datagram) {
  for (const auto generation : {wire::Generation::document, wire::Generation::identified}) {
    for (const auto abi : {wire::Abi::lp64, wire::Abi::llp64, wire::Abi::i386}) {
      for (const auto order : {wire::ByteOrder::little, wire::ByteOrder::big}) {
        wire::LayoutDetector detector({generation, abi, order});
        test::claim(test::broken_claim(datagram, detector));
        const auto seen = detector.seen();
        if (seen && *seen != wire::Layout{generation, abi, order}) test::claim("a layout other than the one given");
      }
    }
  }
}

/// What a sender's record teaches does not change how the same record is read.
void claim_same_again(std::string_view datagram, wire::LayoutDetector& detector) {
  const auto first = wire::decode(datagram, detector);
  const auto second = wire::decode(datagram, detector);
  if (first.has_value() != second.has_value()) test::claim("a record once and a fault once");
  if (first && (first->record != second->record || first->form.layout != second->form.layout)) {
    test::claim("two records from the same bytes");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view datagram(reinterpret_cast<const char*>(data), size);
  wire::LayoutDetector detector;
  test::claim(test::broken_claim(datagram, detector));
  claim_same_again(datagram, detector);
  if (datagram.size() > wire::header_size && datagram[7] == 'B') claim_with_given_layout(datagram);
  return 0;
}
