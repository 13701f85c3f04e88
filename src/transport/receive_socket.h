// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Receives datagrams on a UDP port.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "interfaces.h"
#include "socket.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::transport {

/// Where to listen.
///
/// The host is an address of this machine, a multicast group, which is joined, or a broadcast address. Empty and `::`
/// mean every interface with IPv4 and IPv6, `0.0.0.0` every interface with IPv4 only. Several readers can share a group
/// or a broadcast address (if it is one when opened), and each receives every datagram. For all other addresses, the
/// kernel gives a datagram to one reader only, so that a second reader is refused.
///
/// Address and interface need not exist yet and may disappear and return: datagrams are received while they exist.
struct ReceiveSettings {
  std::string host;        ///< IPv6 without brackets; a name is looked up when the socket is opened, IPv4 before IPv6
  std::uint16_t port = 0;  ///< 0: the kernel selects one, see name()
  /// An address of this machine or the name of an interface, for groups. Empty: every interface that supports
  /// multicast, and the loopback, each as soon as it is up.
  std::string interface;
  std::vector<std::string> allow;  ///< accepted senders; empty: all
  /// Receive buffer of the kernel in bytes, 1 to 1073741823. Opening fails if the kernel grants less. None:
  /// default_receive_buffer, or as much of it as the kernel grants.
  std::optional<int> buffer;
  /// Whether datagrams have receive times, which cost the kernel some time for each datagram.
  bool has_arrivals = true;
};

/// Enough for 0.2 s of 256 cameras at 120 Hz if the kernel counts at most 2730 bytes per datagram (on the loopback, it
/// counts 1280 for 200 to 600 bytes). The kernel counts its own overhead and allows twice the granted size.
inline constexpr int default_receive_buffer = 8 << 20;

/// Whether a read error is permanent. Other errors concern one datagram or are temporary, such as an interface that
/// went down.
bool is_permanent(int error) noexcept;

/// Bound from construction to destruction. Addresses that exist on each interface separately (fe80::1%eth0, ff02::7)
/// are bound while their interface exists. One thread at a time, except for stop(), granted_buffer(), kernel_drops()
/// and why_nothing_can_arrive(); reading allocates nothing. For groups and link-local addresses, a separate thread
/// watches the interfaces.
class ReceiveSocket {
 public:
  /// Throws TransportError.
  explicit ReceiveSocket(const ReceiveSettings&);
  ReceiveSocket(const ReceiveSocket&) = delete;
  ReceiveSocket& operator=(const ReceiveSocket&) = delete;

  /// "udp port 7000 on every interface".
  const std::string& name() const noexcept { return name_; }
  std::uint16_t port() const noexcept { return port_; }
  /// Readable when a datagram is available.
  int fd() const noexcept { return readable_.is_open() ? readable_.get() : socket_.get(); }
  /// Ends next(), now and in future. Any thread, safe in a signal handler; errno is not changed.
  void stop() noexcept;
  /// The requested and the granted buffer size, in bytes as in ReceiveSettings::buffer. Any thread.
  int wanted_buffer() const noexcept { return settings_.buffer.value_or(default_receive_buffer); }
  int granted_buffer() const noexcept;
  /// Datagrams that the kernel has dropped because they were not read in time. Any thread.
  std::uint64_t kernel_drops() const noexcept;
  /// "interface eth0 is down"; empty if address, interface and group are usable. Any thread.
  std::string why_nothing_can_arrive() const;

  /// One datagram.
  struct Datagram {
    std::string_view bytes;
    bool was_longer = false;  ///< longer than wire::max_datagram; `bytes` has its beginning
    Sender sender;
    bool is_allowed = true;    ///< the sender
    std::int64_t arrival = 0;  ///< ns since 1970 UTC, from the kernel; 0 without `has_arrivals`
  };
  /// The next datagram; its bytes are valid until the next call. None if there is no datagram or, with errno in
  /// `error`, if the system call failed. With `waits`, it waits for a datagram, but may also return none, so that the
  /// caller can check whether to continue.
  std::optional<Datagram> next(bool waits, int& error) noexcept;
  /// False: next() has returned all datagrams of its last system call, and there were no more then.
  bool has_more() const noexcept { return next_ < count_ || count_ == batch; }

 private:
  static constexpr std::size_t batch = 32;  // datagrams per system call
  struct Control {
    alignas(cmsghdr) char data[CMSG_SPACE(sizeof(timespec))];
  };

  /// Replaces the socket; the number of the descriptor does not change.
  void replace_socket(const Descriptor& with);
  void listen_through(unsigned interface_index);
  void follow_interfaces(const InterfaceWatch::Removed& removed);
  bool try_to_follow_interfaces(const InterfaceWatch::Removed& removed);

  void prepare(msghdr& header) const noexcept;
  int fill(bool waits) noexcept;
  std::int64_t arrival(std::size_t i) noexcept;
  bool is_allowed(const Sender&) const noexcept;

  const ReceiveSettings settings_;
  SocketAddress address_;  // without a zone
  const bool is_group_;
  const std::string interface_;  // the interface that must be used; empty: none
  Descriptor socket_;
  Descriptor readable_;  // an epoll set with the socket: poll() does not notice that a socket was replaced
  std::atomic<bool> stopped_{false};
  std::string name_;
  std::uint16_t port_ = 0;
  std::vector<Sender> allowed_;

  std::size_t next_ = 0, count_ = 0;
  std::array<mmsghdr, batch> headers_{};
  std::array<iovec, batch> parts_{};
  std::array<sockaddr_storage, batch> senders_{};
  std::array<Control, batch> controls_{};
  std::array<wire::Buffer, batch> data_{};

  std::set<unsigned> listens_through_;   // interfaces that were joined or bound to
  mutable std::mutex mutex_;             // protects the next two members
  std::uint64_t earlier_drops_ = 0;      // of replaced sockets
  std::string problem_;                  // of the last attempt to follow the interfaces; empty: none
  std::optional<InterfaceWatch> watch_;  // must be the last member: its thread uses the others
};

}  // namespace trk_bridge::transport
