// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Decodes datagrams of any protocol, for `trk detect`.
#pragma once

#include <string_view>
#include <vector>

#include "transport/datagram.h"

namespace trk_bridge::tools {

/// Tries all readings of a datagram that the schemes offer, and uses the first without a fault. Not synchronised.
class AnyDecoder final : public transport::Decoder {
 public:
  /// A way to decode a protocol.
  struct Reading {
    const transport::Scheme* scheme;
    transport::Detection::Reading way;
  };

  AnyDecoder();

  void begin(std::string_view datagram, const transport::Sender&) noexcept override;
  Next next(transport::Sample& into, transport::Fault& fault) noexcept override;

  /// All readings, in a fixed order.
  const std::vector<Reading>& readings() const noexcept { return readings_; }
  /// The reading of the datagram of the last begin(); null: none.
  const Reading* chosen() const noexcept { return chosen_; }
  /// The protocol that the datagram seems to have; null: none.
  const transport::Scheme* claimed_by() const noexcept { return claimed_by_; }
  std::string_view datagram() const noexcept { return datagram_; }

 private:
  std::vector<Reading> readings_;
  std::string_view datagram_;
  const Reading* chosen_ = nullptr;
  const transport::Scheme* claimed_by_ = nullptr;
  // The result of the first next(), which begin() needs to choose a reading.
  bool is_first_ = false;
  Next first_ = Next::none;
  transport::Sample sample_;
  transport::Fault fault_;
};

}  // namespace trk_bridge::tools
