// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "any_decoder.h"

#include <string>
#include <utility>

#include "endpoints/schemes.h"

namespace trk_bridge::tools {
namespace {

transport::Fault unknown_protocol() noexcept {
  return {"unknown protocol", [](const transport::Fault&) { return std::string("unknown protocol"); }, 0, -1};
}

}  // namespace

AnyDecoder::AnyDecoder() {
  for (const auto* scheme : endpoints::schemes()) {
    if (scheme->detection == nullptr) continue;
    for (auto& way : scheme->detection->readings()) readings_.push_back({scheme, std::move(way)});
  }
}

void AnyDecoder::begin(std::string_view datagram, const transport::Sender& sender) noexcept {
  datagram_ = datagram;
  chosen_ = nullptr;
  claimed_by_ = nullptr;
  is_first_ = true;
  first_ = Next::fault;
  fault_ = unknown_protocol();
  for (const Reading& reading : readings_) {
    if (!reading.scheme->detection->claims(datagram)) continue;
    // All decoders process every datagram completely, because they may reassemble segments.
    reading.way.decoder->begin(datagram, sender);
    transport::Sample sample;
    transport::Fault fault;
    Next next = reading.way.decoder->next(sample, fault);
    const bool is_strictest = std::exchange(claimed_by_, reading.scheme) == nullptr;
    if (chosen_ == nullptr && next != Next::fault) {
      chosen_ = &reading;
      first_ = next;
      sample_ = sample;
      continue;
    }
    if (is_strictest) fault_ = fault;
    while (next != Next::none) next = reading.way.decoder->next(sample, fault);
  }
}

transport::Decoder::Next AnyDecoder::next(transport::Sample& into, transport::Fault& fault) noexcept {
  if (std::exchange(is_first_, false)) {
    // The decoder does not know sender and arrival.
    sample_.sender = into.sender;
    sample_.arrival = into.arrival;
    into = sample_;
    fault = fault_;
    return first_;
  }
  if (chosen_ == nullptr) return Next::none;
  return chosen_->way.decoder->next(into, fault);
}

}  // namespace trk_bridge::tools
