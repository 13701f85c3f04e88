// Datagrams of any protocol to samples, for finding out who sends what.
#pragma once

#include <string_view>
#include <vector>

#include "transport/datagram.h"

namespace trk_bridge::tools {

/// Tries every way to read a datagram that the schemes offer, and takes the first that finds no fault. Not
/// synchronised.
class AnyDecoder final : public transport::Decoder {
 public:
  /// A way to read a protocol.
  struct Reading {
    const transport::Scheme* scheme;
    transport::Detection::Reading way;
  };

  AnyDecoder();

  void begin(std::string_view datagram, const transport::Sender&) noexcept override;
  Next next(transport::Sample& into, transport::Fault& fault) noexcept override;

  /// All of them, in an order that stays.
  const std::vector<Reading>& readings() const noexcept { return readings_; }
  /// Of the datagram of the last begin(): the way it is read; null: none.
  const Reading* chosen() const noexcept { return chosen_; }
  /// The protocol that it claims to be of; null: none.
  const transport::Scheme* claimed_by() const noexcept { return claimed_by_; }
  std::string_view datagram() const noexcept { return datagram_; }

 private:
  std::vector<Reading> readings_;
  std::string_view datagram_;
  const Reading* chosen_ = nullptr;
  const transport::Scheme* claimed_by_ = nullptr;
  // What the first next() gives: begin() has to ask for it, to choose.
  bool is_first_ = false;
  Next first_ = Next::none;
  transport::Sample sample_;
  transport::Fault fault_;
};

}  // namespace trk_bridge::tools
