// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "receive_socket.h"

#include <fcntl.h>
#include <linux/sock_diag.h>
#include <sys/epoll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "base/clock.h"
#include "base/system_text.h"
#include "socket.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {
namespace {

bool is_every_interface(const std::string& host) { return host.empty() || host == "::"; }

SocketAddress address_of(const ReceiveSettings& settings) {
  if (is_every_interface(settings.host)) return any_ipv6(settings.port);
  return resolve(settings.host, settings.port).front();
}

std::string described(const ReceiveSettings& settings, const SocketAddress& address, std::uint16_t port_number) {
  const std::string port = "udp port " + std::to_string(port_number);
  if (is_multicast(address)) {
    return port + " of group " + settings.host + (settings.interface.empty() ? "" : " through " + settings.interface);
  }
  if (is_any(address)) return port + " on every interface" + (settings.host == "0.0.0.0" ? " (IPv4)" : "");
  return port + " on " + settings.host;
}

std::uint16_t port_in(const SocketAddress& address) {
  return static_cast<std::uint16_t>(sender_of(address.storage).number);
}

/// Ends every wait for the socket, now and later; its queue can still be read. Linux does this although it returns
/// ENOTCONN.
void end_waits(int fd) noexcept { (void)::shutdown(fd, SHUT_RD); }

Descriptor open_socket(int family) { return Descriptor(::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0)); }

void bind_or_throw(int fd, const SocketAddress& address, bool shareable) {
  if (::bind(fd, address.get(), address.length) == 0) return;
  switch (errno) {
    case EADDRINUSE:
      throw TransportError(std::string("the port is in use") +
                           (shareable ? " by a program that does not share it"
                                      : ": the kernel gives a datagram to one reader only; several readers can share a "
                                        "multicast group or a broadcast address"));
    case EACCES:
      throw TransportError("this port is reserved for privileged programs");
    default:
      throw TransportError("binding failed: " + base::system_text(errno));
  }
}

/// In bytes as requested; the kernel doubles the number for its own overhead.
int granted_buffer_of(int fd) noexcept {
  int granted = 0;
  socklen_t size = sizeof granted;
  return ::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &granted, &size) == 0 ? granted / 2 : 0;
}

void set_buffer(int fd, std::optional<int> bytes) {
  const int wanted = bytes.value_or(default_receive_buffer);
  // The first needs a privilege; without it, the second grants up to the limit of the system.
  if (::setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &wanted, sizeof wanted) != 0) {
    set_option(fd, SOL_SOCKET, SO_RCVBUF, wanted, "buffer");
  }
  const int granted = granted_buffer_of(fd);
  if (bytes && granted < wanted) {
    throw TransportError("buffer = " + std::to_string(wanted) + ": the kernel grants " + std::to_string(granted) +
                         " bytes (raise it with sysctl net.core.rmem_max)");
  }
}

// All drops since the socket was opened; unlike SO_RXQ_OVFL, including those after the last datagram that was read.
std::optional<std::uint32_t> dropped_by_kernel(int fd) noexcept {
  std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
  socklen_t size = sizeof info;
  if (::getsockopt(fd, SOL_SOCKET, SO_MEMINFO, info.data(), &size) != 0 || size <= SK_MEMINFO_DROPS * sizeof info[0]) {
    return {};
  }
  return info[SK_MEMINFO_DROPS];
}

/// Opens a socket with all options and binds it. On a machine without IPv6, "every interface" means IPv4 only.
Descriptor open_bound(const ReceiveSettings& settings, SocketAddress& address) {
  const bool every = is_every_interface(settings.host);
  Descriptor socket = open_socket(address.family());
  if (!socket.is_open() && errno == EAFNOSUPPORT && every) {
    address = any_ipv4(settings.port);
    socket = open_socket(AF_INET);
  }
  if (!socket.is_open()) throw TransportError("no socket: " + base::system_text(errno));
  const int fd = socket.get();
  if (address.family() == AF_INET6) set_option(fd, IPPROTO_IPV6, IPV6_V6ONLY, every ? 0 : 1, "IPv6 only");
  const bool group = is_multicast(address);
  const bool shareable = group || is_broadcast(address);
  if (shareable) set_option(fd, SOL_SOCKET, SO_REUSEADDR, 1, "sharing the port");
  if (group) receive_joined_only(fd, address.family());
  set_option(fd, IPPROTO_IP, IP_FREEBIND, 1, "an address that does not exist yet");
  bind_or_throw(fd, address, shareable);
  set_buffer(fd, settings.buffer);
  // The first socket of a machine with this option starts the stamping, which takes the kernel some time: datagrams
  // that arrive before are stamped when they are read.
  if (settings.has_arrivals) set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1, "receive times");
  if (!dropped_by_kernel(fd)) throw TransportError("the kernel does not count its drops (Linux 4.12 or later does)");
  return socket;
}

}  // namespace

bool is_permanent(int error) noexcept {
  return error == EBADF || error == ENOTSOCK || error == EFAULT || error == EINVAL;
}

ReceiveSocket::ReceiveSocket(const ReceiveSettings& settings)
    : settings_(settings),
      address_(address_of(settings)),
      is_group_(is_multicast(address_)),
      interface_(interface_of(settings.host, settings.interface)) {
  if (!settings.interface.empty() && !is_group_) {
    throw TransportError("interface = \"" + settings.interface +
                         "\" is for multicast: to receive on one interface only, give its address as the host");
  }
  const bool is_tied = needs_zone(address_);
  if (is_tied && interface_.empty()) {
    throw TransportError(std::string("this ") + (is_group_ ? "group" : "address") + " exists on each link: " +
                         (is_group_ ? "interface=ADDR" : "%INTERFACE after it") + " must select one");
  }
  if (is_group_ || is_tied) watch_.emplace();
  if (is_tied) {
    readable_ = Descriptor(::epoll_create1(EPOLL_CLOEXEC));
    if (!readable_.is_open()) throw TransportError("no descriptor for waiting: " + base::system_text(errno));
  }
  socket_ = is_tied ? open_socket(AF_INET6) : open_bound(settings_, address_);
  follow_interfaces({});
  port_ = port_in(is_tied && listens_through_.empty() ? address_ : bound_address(socket_.get()));
  if (port_ == 0) throw TransportError("port = 0: " + why_nothing_can_arrive());
  set_port(address_, port_);
  name_ = described(settings, address_, port_);
  for (const std::string& host : settings.allow) {
    for (const SocketAddress& address : resolve(host, 0)) allowed_.push_back(sender_of(address.storage));
  }
  for (std::size_t i = 0; i < batch; ++i) {
    msghdr& header = headers_[i].msg_hdr;
    header = {};
    parts_[i] = {data_[i].data(), data_[i].size()};
    header.msg_iov = &parts_[i];
    header.msg_iovlen = 1;
    header.msg_name = &senders_[i];
    if (settings.has_arrivals) header.msg_control = controls_[i].data;
    prepare(header);
  }
  if (watch_)
    watch_->start([this](const InterfaceWatch::Removed& removed) { return try_to_follow_interfaces(removed); });
}

void ReceiveSocket::replace_socket(const Descriptor& with) {
  epoll_event readable{};
  readable.events = EPOLLIN;
  const std::lock_guard lock(mutex_);
  const Descriptor old(::fcntl(socket_.get(), F_DUPFD_CLOEXEC, 0));
  if (!old.is_open() || ::dup3(with.get(), socket_.get(), O_CLOEXEC) < 0) {
    throw TransportError("no socket: " + base::system_text(errno));
  }
  earlier_drops_ += dropped_by_kernel(old.get()).value_or(0);
  // A reader that waits on the old socket must continue on the new one, and stop() may have seen only the old one.
  end_waits(old.get());
  if (stopped_) end_waits(socket_.get());
  // The kernel removes the old one from the set when its last descriptor is closed.
  if (::epoll_ctl(readable_.get(), EPOLL_CTL_ADD, socket_.get(), &readable) != 0) {
    throw TransportError("no socket: " + base::system_text(errno));
  }
}

void ReceiveSocket::stop() noexcept {
  const int saved = errno;
  stopped_ = true;
  end_waits(socket_.get());
  errno = saved;
}

void ReceiveSocket::listen_through(unsigned interface_index) {
  if (needs_zone(address_) && zone_index(bound_address(socket_.get())) != interface_index) {
    SocketAddress address = address_;
    set_zone(address, interface_index);
    replace_socket(open_bound(settings_, address));
    listens_through_.clear();
  }
  if (!is_group_ || join_group(socket_.get(), address_, interface_index)) listens_through_.insert(interface_index);
}

void ReceiveSocket::follow_interfaces(const InterfaceWatch::Removed& removed) {
  const auto stop_listening = [this](auto is_over) {
    for (auto i = listens_through_.begin(); i != listens_through_.end();) {
      // The kernel stores the memberships of a socket even if the interface is gone, and refuses to join again.
      if (is_over(*i)) leave_group(socket_.get(), address_, *i);
      i = is_over(*i) ? listens_through_.erase(i) : std::next(i);
    }
  };
  stop_listening([&removed](unsigned index) { return removed.has(index); });
  if (!is_group_ && !needs_zone(address_)) return;
  std::vector<unsigned> wanted;
  if (interface_.empty()) {
    wanted = multicast_interfaces(address_.family());
  } else if (const auto interface = find_interface(interface_)) {
    wanted = {interface->index};
  }
  std::optional<TransportError> problem;
  for (const unsigned index : wanted) {
    try {
      if (listens_through_.count(index) == 0) listen_through(index);
    } catch (const TransportError& error) {
      problem = error;
    }
  }
  if (problem) throw TransportError(*problem);
  // Another interface has the name or address now.
  if (!interface_.empty() && !wanted.empty()) {
    stop_listening([&wanted](unsigned index) { return index != wanted.front(); });
  }
}

bool ReceiveSocket::try_to_follow_interfaces(const InterfaceWatch::Removed& removed) {
  std::string problem;
  try {
    follow_interfaces(removed);
  } catch (const TransportError& error) {
    problem = error.what();
  }
  const std::lock_guard lock(mutex_);
  problem_ = std::move(problem);
  return problem_.empty();
}

std::string ReceiveSocket::why_nothing_can_arrive() const {
  try {
    if (!interface_.empty()) {
      if (std::string why = why_unusable(interface_); !why.empty()) return why;
    }
    if (is_group_ && interface_.empty() && multicast_interfaces(address_.family()).empty()) {
      return std::string("no interface that is up receives multicast of ") +
             (address_.family() == AF_INET ? "IPv4" : "IPv6");
    }
    if (!is_group_ && !is_local(bound_address(socket_.get()))) {
      return "no interface that is up has the address " + settings_.host;
    }
    if (!is_group_ && interface_.empty()) {
      const auto interface = find_interface(settings_.host);
      if (interface && !interface->is_up) return "the interface with the address " + settings_.host + " is down";
    }
  } catch (const TransportError& error) {
    return error.what();
  }
  const std::lock_guard lock(mutex_);
  return problem_;
}

int ReceiveSocket::granted_buffer() const noexcept { return granted_buffer_of(socket_.get()); }

std::uint64_t ReceiveSocket::kernel_drops() const noexcept {
  const std::lock_guard lock(mutex_);
  return earlier_drops_ + dropped_by_kernel(socket_.get()).value_or(0);
}

void ReceiveSocket::prepare(msghdr& header) const noexcept {
  header.msg_namelen = sizeof(sockaddr_storage);
  header.msg_controllen = settings_.has_arrivals ? sizeof(Control) : 0;
}

int ReceiveSocket::fill(bool waits) noexcept {
  // Resets the headers that the last call has changed.
  for (std::size_t i = 0; i < count_; ++i) prepare(headers_[i].msg_hdr);
  const int received =
      ::recvmmsg(socket_.get(), headers_.data(), batch, waits ? MSG_WAITFORONE : MSG_DONTWAIT, nullptr);
  // The end of a wait looks like an empty datagram without a sender.
  if (received > 0 && headers_[0].msg_hdr.msg_namelen == 0) {
    prepare(headers_[0].msg_hdr);
    errno = EAGAIN;
    return -1;
  }
  return received;
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

std::optional<ReceiveSocket::Datagram> ReceiveSocket::next(bool waits, int& error) noexcept {
  error = 0;
  while (next_ == count_) {
    const int received = fill(waits);
    next_ = 0;
    count_ = received > 0 ? static_cast<std::size_t>(received) : 0;
    if (received > 0) break;
    if (received < 0 && errno == EINTR) continue;
    if (received < 0 && errno != EAGAIN && errno != EWOULDBLOCK) error = errno;
    return std::nullopt;
  }
  const std::size_t i = next_++;
  Datagram datagram;
  datagram.bytes = {data_[i].data(), headers_[i].msg_len};
  datagram.was_longer = (headers_[i].msg_hdr.msg_flags & MSG_TRUNC) != 0;
  datagram.sender = sender_of(senders_[i]);
  datagram.is_allowed = is_allowed(datagram.sender);
  if (settings_.has_arrivals) datagram.arrival = arrival(i);
  return datagram;
}

}  // namespace trk_bridge::transport
