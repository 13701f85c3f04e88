// OpenTrackIO's packets to samples.
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

/// Puts segments together, passes over packets that come twice, and makes records of samples: of the static part
/// constants, of the rest parameters. A sample's fault that concerns a part of it comes behind its records.
class PacketDecoder final : public transport::Decoder {
 public:
  /// Of samples of several segments.
  static constexpr std::size_t capacity = 64;

  PacketDecoder(bool takes_any, int tai_offset) : reader_(takes_any, tai_offset) {}

  void begin(std::string_view datagram, const transport::Sender&) noexcept override;
  Next next(transport::Sample& into, transport::Fault& fault) noexcept override;

 private:
  /// A packet that was seen.
  struct Seen {
    std::size_t hash = 0;
    std::size_t size = 0;  ///< 0: none
    unsigned copies = 0;
  };
  /// Packets that are remembered, of all senders together.
  static constexpr std::size_t window = 256;
  /// More copies are of a sender that sends the same again and again and does not count.
  static constexpr unsigned most_copies = 3;

  bool is_copy(std::string_view datagram) noexcept;
  std::optional<std::string_view> assembled(const Packet&, const transport::Sender&) noexcept;

  RecordsReader reader_;
  transport::PerSender<Assembly, capacity> assemblies_;
  std::array<Seen, window> seen_{};
  std::size_t next_seen_ = 0;

  // Of the datagram, what next() has not given yet.
  std::optional<transport::Fault> fault_;
  Encoding encoding_{};
  Sample sample_;
  Records records_;
};

}  // namespace trk_bridge::opentrackio
