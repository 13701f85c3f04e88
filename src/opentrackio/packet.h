// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// OpenTrackIO packets: a header of 16 bytes and a segment of a sample.
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
/// With the headers of packet, UDP and IPv6: 1500 bytes, which Ethernet does not fragment. (With IPv4, 1456 would fit.)
inline constexpr std::size_t most_payload = 1436;
/// The largest sample, all segments together.
inline constexpr std::size_t most_bytes = 65536;
/// The deepest nesting of objects and lists.
inline constexpr std::size_t most_depth = 32;

/// A valid packet. `payload` refers to the bytes of the datagram.
struct Packet {
  Encoding encoding{};
  std::uint16_t sequence = 0;
  std::uint32_t offset = 0;  ///< of the payload in the sample
  bool is_last = false;
  std::string_view payload;
};

/// Whether a datagram begins like a packet.
bool claims(std::string_view datagram) noexcept;
[[nodiscard]] tl::expected<Packet, Reason> packet_of(std::string_view datagram) noexcept;

/// A buffer for a packet to be written.
using PacketBuffer = std::array<char, header_size + most_payload>;
/// Writes the datagram into `into`. The payload has at most most_payload bytes.
[[nodiscard]] std::string_view write(const Packet&, PacketBuffer& into) noexcept;

/// Assembles the segments of one sender, which must arrive in order.
class Assembly {
 public:
  /// With the last segment, returns the complete sample, whose bytes are valid until the next call. If a sample lacks a
  /// segment, returns nothing and sets `lost`; the packet may be the first of the next sample. Allocates for samples of
  /// several segments, until its buffer is large enough.
  [[nodiscard]] std::optional<std::string_view> add(const Packet&, std::optional<Reason>& lost);

 private:
  std::string bytes_;
  bool is_open_ = false;      // segments were received, but not the last one
  bool is_skipping_ = false;  // skips the rest of a sample that lacks a segment
  std::uint16_t next_ = 0;
  Encoding encoding_{};
};

}  // namespace trk_bridge::opentrackio
