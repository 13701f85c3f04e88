// Who a record came from: small, comparable, never allocates.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace trk_bridge::transport {

/// What `Sender::number` and `Sender::address` mean.
enum class SenderKind : std::uint8_t { none, ipv4, ipv6, shm, file, memory };

/// An address and port, a slot, or what else a record comes from.
struct Sender {
  SenderKind kind = SenderKind::none;
  std::array<std::uint8_t, 16> address{};  ///< network byte order; IPv4 in the first four, mapped IPv4 counts as IPv4
  std::uint32_t number = 0;                ///< port, slot
};

inline bool operator==(const Sender& a, const Sender& b) noexcept {
  return a.kind == b.kind && a.number == b.number && a.address == b.address;
}
inline bool operator!=(const Sender& a, const Sender& b) noexcept { return !(a == b); }

/// "192.0.2.7:50123", "[fe80::1]:50123", "slot 7", "file", "memory", "-".
std::string to_string(const Sender&);

}  // namespace trk_bridge::transport
