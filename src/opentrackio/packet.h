// OpenTrackIO's packets: 16 bytes of header and a segment of a sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "fault.h"
#include "sample.h"

namespace trk_bridge::opentrackio {

inline constexpr std::size_t header_size = 16;
/// With the headers of packet, UDP and IPv6 it is 1500 bytes, which no Ethernet fragments. (IPv4 has room for 1456.)
inline constexpr std::size_t most_payload = 1436;
/// A sample, all segments together.
inline constexpr std::size_t most_bytes = 65536;
/// Of objects and lists within each other.
inline constexpr std::size_t most_depth = 32;

/// A sound packet. `payload` are the datagram's own bytes.
struct Packet {
  Encoding encoding{};
  std::uint16_t sequence = 0;
  std::uint32_t offset = 0;  ///< of the payload in the sample
  bool is_last = false;
  std::string_view payload;
};

/// Whether a datagram begins as a packet, whatever follows.
bool claims(std::string_view datagram) noexcept;
[[nodiscard]] tl::expected<Packet, Reason> packet_of(std::string_view datagram) noexcept;

/// Room for a packet that is written.
using PacketBuffer = std::array<char, header_size + most_payload>;
/// The whole datagram, in `into`. The payload has at most most_payload bytes.
[[nodiscard]] std::string_view write(const Packet&, PacketBuffer& into) noexcept;

/// Puts one sender's segments together, which have to come in their order.
class Assembly {
 public:
  /// The whole sample with its last segment, whose bytes stay until the next call. Nothing, and `lost` set, where a
  /// sample lacks a segment; the packet may be the first of the next one. Allocates for samples of several segments,
  /// until it has room for them.
  [[nodiscard]] std::optional<std::string_view> add(const Packet&, std::optional<Reason>& lost);

 private:
  std::string bytes_;
  bool is_open_ = false;      // segments came, the last one did not
  bool is_skipping_ = false;  // until a first segment: the rest of a sample that lacks one
  std::uint16_t next_ = 0;
  Encoding encoding_{};
};

}  // namespace trk_bridge::opentrackio
