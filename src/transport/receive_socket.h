// A UDP port that datagrams are read from.
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
/// stand for every interface and both families, `0.0.0.0` for every interface and IPv4 alone. Several readers share a
/// group or a broadcast address (one that is so when it is opened) and each gets every datagram; the kernel gives a
/// datagram to one address to one reader only, so that a second reader elsewhere is refused.
///
/// Address and interface need not be there yet, and may go and come: what they receive is read while they are there.
struct ReceiveSettings {
  std::string host;        ///< IPv6 without its brackets; a name is looked up at opening, IPv4 before IPv6
  std::uint16_t port = 0;  ///< 0: the kernel picks one, name() has it
  /// An address of this machine or an interface's name, for groups. Empty: every interface that can do multicast, and
  /// the loopback, each from when it is up.
  std::string interface;
  std::vector<std::string> allow;  ///< senders accepted; empty: all
  /// The kernel's receive buffer in bytes, 1 to 1073741823. Opening fails when the kernel grants less. None:
  /// default_receive_buffer, or as much of it as the kernel grants.
  std::optional<int> buffer;
  /// Whether datagrams have their receive times, which take the kernel a moment each.
  bool has_arrivals = true;
};

/// Holds 0.2 s of 256 cameras at 120 Hz where the kernel counts at most 2730 bytes for a datagram (on the loopback 1280
/// for 200 to 600 bytes). It counts its own bookkeeping and allows twice what it grants.
inline constexpr int default_receive_buffer = 8 << 20;

/// Whether an error of reading is one that stays. Others are of one datagram or one moment, such as an interface that
/// went down.
bool is_lasting(int error) noexcept;

/// Bound from construction to destruction; to an address that is another one on each interface (fe80::1%eth0, ff02::7),
/// when that is there. One thread at a time but for stop(), granted_buffer(), kernel_drops() and
/// why_nothing_can_come(); reading allocates nothing. A thread of its own follows the interfaces of groups and of such
/// addresses.
class ReceiveSocket {
 public:
  /// Throws TransportError.
  explicit ReceiveSocket(const ReceiveSettings&);
  ReceiveSocket(const ReceiveSocket&) = delete;
  ReceiveSocket& operator=(const ReceiveSocket&) = delete;

  /// "udp port 7000 on every interface".
  const std::string& name() const noexcept { return name_; }
  std::uint16_t port() const noexcept { return port_; }
  /// Readable when the next datagram is there.
  int fd() const noexcept { return readable_.is_open() ? readable_.get() : socket_.get(); }
  /// Wakes next() for good. Any thread, safe in a signal handler; errno stays.
  void stop() noexcept;
  /// What the kernel was asked for and what it grants, in bytes as in ReceiveSettings::buffer. Any thread.
  int wanted_buffer() const noexcept { return settings_.buffer.value_or(default_receive_buffer); }
  int granted_buffer() const noexcept;
  /// Datagrams that the kernel threw away so far because nobody read in time. Any thread.
  std::uint64_t kernel_drops() const noexcept;
  /// "interface eth0 is down"; empty where nothing is wrong with address, interface and group. Any thread.
  std::string why_nothing_can_come() const;

  /// One datagram.
  struct Datagram {
    std::string_view bytes;
    bool was_longer = false;  ///< than wire::max_datagram; `bytes` are its beginning
    Sender sender;
    bool is_allowed = true;    ///< the sender
    std::int64_t arrival = 0;  ///< ns since 1970 UTC: the kernel's stamp; 0 without `has_arrivals`
  };
  /// The next datagram; its bytes stay until the next call. None when nothing is there or, with errno in `error`, the
  /// system refused. `waits`: until one is there, but none as well when it is time to look whether to go on.
  std::optional<Datagram> next(bool waits, int& error) noexcept;
  /// False: when next() last asked the system, no more were there than it has given since.
  bool has_more() const noexcept { return next_ < count_ || count_ == batch; }

 private:
  static constexpr std::size_t batch = 32;  // datagrams that one system call takes
  struct Control {
    alignas(cmsghdr) char data[CMSG_SPACE(sizeof(timespec))];
  };

  /// Takes a socket for the one that it reads from, whose number stays.
  void replace_socket(const Descriptor& with);
  void listen_through(unsigned interface_index);
  void follow_interfaces(const InterfaceWatch::Removed& removed);
  bool follow_or_say_why(const InterfaceWatch::Removed& removed);

  void prepare(msghdr& header) const noexcept;
  int fill(bool waits) noexcept;
  std::int64_t arrival(std::size_t i) noexcept;
  bool is_allowed(const Sender&) const noexcept;

  const ReceiveSettings settings_;
  SocketAddress address_;  // without a zone
  const bool is_group_;
  const std::string interface_;  // that it is tied to; empty: none
  Descriptor socket_;
  Descriptor readable_;  // a set with the socket in it: poll() does not see that a socket was replaced
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

  std::set<unsigned> listens_through_;   // what was joined, or bound to
  mutable std::mutex mutex_;             // of the next two
  std::uint64_t earlier_drops_ = 0;      // of sockets that were replaced
  std::string trouble_;                  // the last time that it followed the interfaces; empty: none
  std::optional<InterfaceWatch> watch_;  // the last one: its thread uses the others
};

}  // namespace trk_bridge::transport
