// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Decodes trk datagrams to samples.
#pragma once

#include <cstddef>
#include <string_view>

#include "transport/datagram.h"
#include "transport/per_sender.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::trk {

/// Whether a datagram begins like trk or like TrackMen's packet.
bool claims(std::string_view datagram) noexcept;

/// Decodes with a LayoutDetector per sender. Stores only senders of valid records; beyond `capacity`, a new one
/// replaces the one that was silent longest. TrackMen's packets are recognised by their magic.
class DatagramDecoder final : public transport::Decoder {
 public:
  static constexpr std::size_t capacity = 64;

  /// `layout` applies to every sender.
  explicit DatagramDecoder(const wire::LayoutChoice& layout) : layout_(layout) {}

  void begin(std::string_view datagram, const transport::Sender&) noexcept override;
  Next next(transport::Sample& into, transport::Fault& fault) noexcept override;

 private:
  bool decode(wire::Record& into, wire::DecodedForm& form, wire::Fault& fault) noexcept;

  wire::LayoutChoice layout_;
  std::string_view datagram_;
  transport::Sender sender_;  // of the datagram
  bool is_given_ = true;      // next() has returned its sample
  transport::PerSender<wire::LayoutDetector, capacity> detectors_;
};

}  // namespace trk_bridge::trk
