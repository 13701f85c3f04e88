#include "receive_socket.h"

#include <linux/sock_diag.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>
#include <utility>

#include "base/clock.h"
#include "socket.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {
namespace {

std::string system_text(int error) { return std::generic_category().message(error); }

std::string describe_place(const ReceiveSettings& settings, const SocketAddress& address) {
  const std::string port = "udp port " + std::to_string(sender_of(address.storage).number);
  if (is_multicast(address)) {
    return port + " of group " + settings.host + (settings.interface.empty() ? "" : " through " + settings.interface);
  }
  if (is_any(address)) return port + " on every interface" + (settings.host == "0.0.0.0" ? " (IPv4)" : "");
  return port + " on " + settings.host;
}

// An IPv6 group of one machine or one link means nothing without the interface.
void set_zone(SocketAddress& address, const std::string& interface) {
  if (address.family() != AF_INET6) return;
  auto& ipv6 = reinterpret_cast<sockaddr_in6&>(address.storage);
  if (!interface.empty()) ipv6.sin6_scope_id = find_interface(interface).index;
  const bool narrow = IN6_IS_ADDR_MC_NODELOCAL(&ipv6.sin6_addr) || IN6_IS_ADDR_MC_LINKLOCAL(&ipv6.sin6_addr);
  if (narrow && ipv6.sin6_scope_id == 0) {
    throw TransportError("this group is one on each link: interface=ADDR has to say which");
  }
}

struct Bound {
  Descriptor socket;
  SocketAddress address;
};

Descriptor open_socket(int family) {
  return Descriptor(::socket(family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

void bind_or_say_why(const Bound& bound, bool shareable) {
  if (::bind(bound.socket.get(), bound.address.get(), bound.address.length) == 0) return;
  switch (errno) {
    case EADDRINUSE:
      throw TransportError(std::string("the port is in use") +
                           (shareable
                                ? " by a program that does not share it"
                                : ": the kernel gives a datagram to one reader alone; several readers can share a "
                                  "multicast group or a broadcast address"));
    case EADDRNOTAVAIL:
      throw TransportError("no interface has this address");
    case EACCES:
      throw TransportError("this port is for privileged programs");
    default:
      throw TransportError("binding failed: " + system_text(errno));
  }
}

Bound open_bound(const ReceiveSettings& settings) {
  Bound bound;
  const bool every = settings.host.empty() || settings.host == "::";
  bound.address = every ? any_ipv6(settings.port) : resolve(settings.host, settings.port).front();
  const bool group = is_multicast(bound.address);
  if (!settings.interface.empty() && !group) {
    throw TransportError("interface = \"" + settings.interface +
                         "\" is for multicast: to hear one interface only, write its address as the host");
  }
  if (group) set_zone(bound.address, settings.interface);
  bound.socket = open_socket(bound.address.family());
  if (!bound.socket.is_open() && errno == EAFNOSUPPORT && every) {
    // A machine without IPv6: every interface is every IPv4 interface.
    bound.address = any_ipv4(settings.port);
    bound.socket = open_socket(AF_INET);
  }
  if (!bound.socket.is_open()) throw TransportError("no socket: " + system_text(errno));
  const int fd = bound.socket.get();
  if (bound.address.family() == AF_INET6) set_option(fd, IPPROTO_IPV6, IPV6_V6ONLY, every ? 0 : 1, "IPv6 only");
  const bool shareable = group || is_broadcast(bound.address);
  if (shareable) set_option(fd, SOL_SOCKET, SO_REUSEADDR, 1, "sharing the port");
  bind_or_say_why(bound, shareable);
  if (group) join_group(fd, bound.address, settings.interface);
  bound.address = bound_address(fd);
  return bound;
}

void enlarge_buffer(int fd, int bytes) {
  // Without the privilege for the first, the second grants as much as the system's limit.
  if (::setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) != 0) {
    set_option(fd, SOL_SOCKET, SO_RCVBUF, bytes, "buffer");
  }
  int granted = 0;
  socklen_t size = sizeof granted;
  if (::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &granted, &size) != 0) {
    throw TransportError("buffer: the system refused: " + system_text(errno));
  }
  // The kernel doubles what is asked for, its own bookkeeping included.
  if (granted / 2 < bytes) {
    throw TransportError("buffer = " + std::to_string(bytes) + ": the kernel grants " + std::to_string(granted / 2) +
                         " bytes (raise it with sysctl net.core.rmem_max)");
  }
}

// Of all datagrams since the socket was opened; unlike SO_RXQ_OVFL also of those after the last one read.
std::optional<std::uint32_t> dropped_by_kernel(int fd) noexcept {
  std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
  socklen_t size = sizeof info;
  if (::getsockopt(fd, SOL_SOCKET, SO_MEMINFO, info.data(), &size) != 0 || size <= SK_MEMINFO_DROPS * sizeof info[0]) {
    return {};
  }
  return info[SK_MEMINFO_DROPS];
}

}  // namespace

ReceiveSocket::ReceiveSocket(const ReceiveSettings& settings) {
  Bound bound = open_bound(settings);
  name_ = describe_place(settings, bound.address);
  port_ = static_cast<std::uint16_t>(sender_of(bound.address.storage).number);
  const int fd = bound.socket.get();
  if (settings.buffer) enlarge_buffer(fd, *settings.buffer);
  // The first socket of a machine to ask wakes the stamping, which takes the kernel a moment: a datagram that comes
  // within it is stamped when it is read.
  set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1, "receive times");
  if (!dropped_by_kernel(fd)) throw TransportError("the kernel does not count its drops (Linux 4.12 or later does)");
  for (const std::string& host : settings.allow) {
    for (const SocketAddress& address : resolve(host, 0)) allowed_.push_back(sender_of(address.storage));
  }
  socket_ = std::move(bound.socket);
  for (std::size_t i = 0; i < batch; ++i) {
    msghdr& header = headers_[i].msg_hdr;
    header = {};
    parts_[i] = {data_[i].data(), data_[i].size()};
    header.msg_iov = &parts_[i];
    header.msg_iovlen = 1;
    header.msg_name = &senders_[i];
    header.msg_control = controls_[i].data;
  }
}

std::uint64_t ReceiveSocket::kernel_drops() const noexcept { return dropped_by_kernel(fd()).value_or(0); }

int ReceiveSocket::fill() noexcept {
  for (auto& header : headers_) {
    header.msg_hdr.msg_namelen = sizeof(sockaddr_storage);
    header.msg_hdr.msg_controllen = sizeof(Control);
  }
  return ::recvmmsg(fd(), headers_.data(), batch, MSG_DONTWAIT, nullptr);
}

std::int64_t ReceiveSocket::arrival(std::size_t i) noexcept {
  msghdr& header = headers_[i].msg_hdr;
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec time{};
    std::memcpy(&time, CMSG_DATA(c), sizeof time);
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
  }
  return base::wall_now();
}

bool ReceiveSocket::is_allowed(const Sender& sender) const noexcept {
  return allowed_.empty() || std::any_of(allowed_.begin(), allowed_.end(), [&sender](const Sender& allowed) {
           return allowed.kind == sender.kind && allowed.address == sender.address;
         });
}

std::optional<ReceiveSocket::Datagram> ReceiveSocket::next(int& error) noexcept {
  error = 0;
  while (next_ == count_) {
    const int came = fill();
    next_ = 0;
    count_ = came > 0 ? static_cast<std::size_t>(came) : 0;
    if (came > 0) break;
    if (came < 0 && errno == EINTR) continue;
    if (came < 0 && errno != EAGAIN && errno != EWOULDBLOCK) error = errno;
    return std::nullopt;
  }
  const std::size_t i = next_++;
  Datagram datagram;
  datagram.bytes = {data_[i].data(), headers_[i].msg_len};
  datagram.was_longer = (headers_[i].msg_hdr.msg_flags & MSG_TRUNC) != 0;
  datagram.sender = sender_of(senders_[i]);
  datagram.is_allowed = is_allowed(datagram.sender);
  datagram.arrival = arrival(i);
  return datagram;
}

}  // namespace trk_bridge::transport
