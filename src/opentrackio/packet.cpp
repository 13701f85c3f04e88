// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "packet.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace trk_bridge::opentrackio {
namespace {

constexpr std::string_view magic = "OTrk";
constexpr std::size_t encoding_at = 5, sequence_at = 6, offset_at = 8, length_at = 12, checksum_at = 14;
constexpr std::uint16_t last_bit = 0x8000;
static_assert(checksum_at + 2 == header_size);
static_assert(40 + 8 + header_size + most_payload == 1500);

std::uint32_t byte(std::string_view bytes, std::size_t at) noexcept { return static_cast<unsigned char>(bytes[at]); }
std::uint16_t u16(std::string_view bytes, std::size_t at) noexcept {
  return static_cast<std::uint16_t>(byte(bytes, at) << 8U | byte(bytes, at + 1));
}
std::uint32_t u32(std::string_view bytes, std::size_t at) noexcept {
  return std::uint32_t{u16(bytes, at)} << 16U | u16(bytes, at + 2);
}
void put16(PacketBuffer& into, std::size_t at, std::uint32_t value) noexcept {
  into[at] = static_cast<char>(value >> 8U);
  into[at + 1] = static_cast<char>(value);
}

/// Fletcher-16, but modulo 256. Sums in more bits give the same result modulo 256.
std::uint16_t checksum(std::string_view header, std::string_view payload) noexcept {
  std::uint32_t sum1 = 0, sum2 = 0;
  const auto add = [&](std::string_view bytes) {
    for (const char c : bytes) {
      sum1 += static_cast<unsigned char>(c);
      sum2 += sum1;
    }
  };
  add(header.substr(0, checksum_at));
  add(payload);
  return static_cast<std::uint16_t>((sum2 & 0xFFU) << 8U | (sum1 & 0xFFU));
}

}  // namespace

bool claims(std::string_view datagram) noexcept { return datagram.substr(0, magic.size()) == magic; }

tl::expected<Packet, Reason> packet_of(std::string_view datagram) noexcept {
  if (datagram.size() < header_size) return tl::unexpected(Reason::truncated);
  if (!claims(datagram)) return tl::unexpected(Reason::bad_magic);
  Packet packet;
  packet.payload = datagram.substr(header_size);
  const std::uint16_t length = u16(datagram, length_at);
  if ((length & ~last_bit) != static_cast<int>(packet.payload.size())) return tl::unexpected(Reason::wrong_length);
  if (u16(datagram, checksum_at) != checksum(datagram, packet.payload)) return tl::unexpected(Reason::wrong_checksum);
  packet.encoding = static_cast<Encoding>(datagram[encoding_at]);
  if (packet.encoding != Encoding::json && packet.encoding != Encoding::cbor) {
    return tl::unexpected(Reason::bad_encoding);
  }
  packet.sequence = u16(datagram, sequence_at);
  packet.offset = u32(datagram, offset_at);
  packet.is_last = (length & last_bit) != 0;
  return packet;
}

std::string_view write(const Packet& packet, PacketBuffer& into) noexcept {
  const std::string_view payload = packet.payload.substr(0, most_payload);
  std::copy(magic.begin(), magic.end(), into.begin());
  into[magic.size()] = 0;
  into[encoding_at] = static_cast<char>(packet.encoding);
  put16(into, sequence_at, packet.sequence);
  put16(into, offset_at, packet.offset >> 16U);
  put16(into, offset_at + 2, packet.offset);
  put16(into, length_at, static_cast<std::uint32_t>(payload.size()) | (packet.is_last ? last_bit : 0U));
  std::copy(payload.begin(), payload.end(), into.begin() + header_size);
  const std::string_view whole(into.data(), header_size + payload.size());
  put16(into, checksum_at, checksum(whole, payload));
  return whole;
}

std::optional<std::string_view> Assembly::add(const Packet& packet, std::optional<Reason>& lost) {
  lost.reset();
  const bool is_first = packet.offset == 0;
  const bool follows =
      is_open_ && packet.sequence == next_ && packet.offset == bytes_.size() && packet.encoding == encoding_;
  if (!follows) {
    // Reported once per sample.
    const bool is_rest = !is_open_ && is_skipping_;
    if (std::exchange(is_open_, false) || (!is_first && !is_rest)) lost = Reason::lost_segment;
    bytes_.clear();
    is_skipping_ = !is_first && !packet.is_last;
    if (!is_first) return std::nullopt;
  }
  if (is_first && packet.is_last) {
    is_open_ = false;
    return packet.payload;
  }
  if (packet.payload.size() > most_bytes - bytes_.size()) {
    is_open_ = false;
    is_skipping_ = !packet.is_last;
    lost = Reason::too_long;
    return std::nullopt;
  }
  bytes_ += packet.payload;
  next_ = static_cast<std::uint16_t>(packet.sequence + 1);
  encoding_ = packet.encoding;
  is_open_ = !packet.is_last;
  if (is_open_) return std::nullopt;
  return bytes_;
}

}  // namespace trk_bridge::opentrackio
