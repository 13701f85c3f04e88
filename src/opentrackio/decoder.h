// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Decodes OpenTrackIO packets to samples.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "packet.h"
#include "records.h"
#include "transport/datagram.h"
#include "transport/per_sender.h"

namespace trk_bridge::opentrackio {

/// Assembles segments, skips duplicate packets, and converts samples to records: the static part to constants, the rest
/// to parameters. A fault in a part of a sample is returned after its records.
class PacketDecoder final : public transport::Decoder {
 public:
  /// Senders whose samples have several segments.
  static constexpr std::size_t capacity = 64;

  PacketDecoder(bool takes_any, int tai_offset) : reader_(takes_any, tai_offset) {}

  void begin(std::string_view datagram, const transport::Sender&) noexcept override;
  Next next(transport::Sample& into, transport::Fault& fault) noexcept override;

 private:
  /// A received packet.
  struct Seen {
    std::size_t hash = 0;
    std::size_t size = 0;  ///< 0: none
    unsigned copies = 0;
  };
  /// Number of stored packets, of all senders together.
  static constexpr std::size_t window = 256;
  /// More copies come from a sender that repeats its packets and has no sequence numbers.
  static constexpr unsigned most_copies = 3;

  bool is_copy(std::string_view datagram) noexcept;
  std::optional<std::string_view> assembled(const Packet&, const transport::Sender&) noexcept;

  RecordsReader reader_;
  transport::PerSender<Assembly, capacity> assemblies_;
  std::array<Seen, window> seen_{};
  std::size_t next_seen_ = 0;

  // The part of the datagram that next() has not returned yet.
  std::optional<transport::Fault> fault_;
  Encoding encoding_{};
  Sample sample_;
  Records records_;
};

}  // namespace trk_bridge::opentrackio
