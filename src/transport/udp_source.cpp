#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "backends.h"
#include "descriptor.h"
#include "multicast.h"
#include "readable.h"
#include "sender_layouts.h"
#include "socket_address.h"
#include "socket_option.h"
#include "trk_bridge/transport/snapshot.h"
#include "trk_bridge/wire/format.h"
#include "url.h"

namespace trk_bridge::transport {

namespace {

std::string system_text(int error) { return std::generic_category().message(error); }

std::string describe_place(const UdpEndpoint& endpoint, const SocketAddress& address) {
  const std::string port = "udp port " + std::to_string(sender_of(address.storage).number);
  if (is_multicast(address)) {
    return port + " of group " + endpoint.host + (endpoint.interface.empty() ? "" : " through " + endpoint.interface);
  }
  if (is_any(address)) return port + " on every interface" + (endpoint.host == "0.0.0.0" ? " (IPv4)" : "");
  return port + " on " + endpoint.host;
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

Bound open_bound(const UdpEndpoint& endpoint) {
  Bound bound;
  const bool every = endpoint.host.empty() || endpoint.host == "::";
  bound.address = every ? any_ipv6(endpoint.port) : resolve(endpoint.host, endpoint.port).front();
  const bool group = is_multicast(bound.address);
  if (!endpoint.interface.empty() && !group) {
    throw TransportError("interface = \"" + endpoint.interface +
                         "\" is for multicast: to hear one interface only, write its address as the host");
  }
  if (group) set_zone(bound.address, endpoint.interface);
  bound.socket = open_socket(bound.address.family());
  if (!bound.socket.is_open() && errno == EAFNOSUPPORT && every) {
    // A machine without IPv6: every interface is every IPv4 interface.
    bound.address = any_ipv4(endpoint.port);
    bound.socket = open_socket(AF_INET);
  }
  if (!bound.socket.is_open()) throw TransportError("no socket: " + system_text(errno));
  const int fd = bound.socket.get();
  if (bound.address.family() == AF_INET6) set_option(fd, IPPROTO_IPV6, IPV6_V6ONLY, every ? 0 : 1, "IPv6 only");
  const bool shareable = group || is_broadcast(bound.address);
  if (shareable) set_option(fd, SOL_SOCKET, SO_REUSEADDR, 1, "sharing the port");
  bind_or_say_why(bound, shareable);
  if (group) join_group(fd, bound.address, endpoint.interface);
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

std::int64_t nanoseconds_since_1970(const timespec& time) noexcept {
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

/// What one system call takes from the socket.
class Batch {
 public:
  static constexpr std::size_t capacity = 32;

  Batch() {
    for (std::size_t i = 0; i < capacity; ++i) {
      msghdr& header = headers_[i].msg_hdr;
      header = {};
      parts_[i] = {data_[i].data(), data_[i].size()};
      header.msg_iov = &parts_[i];
      header.msg_iovlen = 1;
      header.msg_name = &senders_[i];
      header.msg_control = controls_[i].data;
    }
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// What the call returned: how many came, or -1 with errno set. Never waits.
  int fill(int fd) noexcept {
    for (auto& header : headers_) {
      header.msg_hdr.msg_namelen = sizeof(sockaddr_storage);
      header.msg_hdr.msg_controllen = sizeof(Control);
    }
    return ::recvmmsg(fd, headers_.data(), capacity, MSG_DONTWAIT, nullptr);
  }

  std::string_view datagram(std::size_t i) const noexcept { return {data_[i].data(), headers_[i].msg_len}; }
  bool was_longer(std::size_t i) const noexcept { return (headers_[i].msg_hdr.msg_flags & MSG_TRUNC) != 0; }
  Sender sender(std::size_t i) const noexcept { return sender_of(senders_[i]); }

  /// Nanoseconds since 1970 UTC: the kernel's stamp.
  std::int64_t arrival(std::size_t i) noexcept {
    msghdr& header = headers_[i].msg_hdr;
    timespec time{};
    for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
      if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_TIMESTAMPNS) continue;
      std::memcpy(&time, CMSG_DATA(c), sizeof time);
      return nanoseconds_since_1970(time);
    }
    ::clock_gettime(CLOCK_REALTIME, &time);
    return nanoseconds_since_1970(time);
  }

 private:
  struct Control {
    alignas(cmsghdr) char data[CMSG_SPACE(sizeof(timespec))];
  };

  std::array<mmsghdr, capacity> headers_{};
  std::array<iovec, capacity> parts_{};
  std::array<sockaddr_storage, capacity> senders_{};
  std::array<Control, capacity> controls_{};
  std::array<wire::Buffer, capacity> data_{};
};

struct Counts {
  std::uint64_t records = 0, malformed = 0, refused = 0, unknown_format_bits = 0;
  Sender last_refused;
  int error = 0;  // errno that ended the source
};

class UdpSource final : public Source {
 public:
  explicit UdpSource(const UdpEndpoint& endpoint);

  Event receive(Reception& into, std::chrono::nanoseconds wait) override;
  void stop() noexcept override { stop_.set(); }
  SourceStatistics statistics() const override;
  std::string name() const override { return name_; }

 private:
  /// What the datagram is, or nothing when its sender is not allowed.
  std::optional<Event> judge(std::size_t i, Reception& into) noexcept;
  bool is_allowed(const Sender& sender) const noexcept;
  Event fail(int error) noexcept;

  Bound bound_;
  std::string name_;
  std::vector<Sender> allowed_;
  SenderLayouts layouts_;
  StopEvent stop_;
  Batch batch_;
  std::size_t next_ = 0, count_ = 0;  // of batch_
  Counts counts_;
  Snapshot<Counts> published_;
};

UdpSource::UdpSource(const UdpEndpoint& endpoint) : bound_(open_bound(endpoint)), layouts_(endpoint.layout) {
  name_ = describe_place(endpoint, bound_.address);
  const int fd = bound_.socket.get();
  if (endpoint.buffer) enlarge_buffer(fd, *endpoint.buffer);
  // The first socket of a machine to ask wakes the stamping, which takes the kernel a moment: a datagram that comes
  // within it is stamped when it is read.
  set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1, "receive times");
  if (!dropped_by_kernel(fd)) throw TransportError("the kernel does not count its drops (Linux 4.12 or later does)");
  for (const std::string& host : endpoint.allow) {
    for (const SocketAddress& address : resolve(host, 0)) allowed_.push_back(sender_of(address.storage));
  }
}

bool UdpSource::is_allowed(const Sender& sender) const noexcept {
  return allowed_.empty() || std::any_of(allowed_.begin(), allowed_.end(), [&sender](const Sender& allowed) {
           return allowed.kind == sender.kind && allowed.address == sender.address;
         });
}

// Errors that stay. Others are of one datagram or one moment, such as an interface that went down.
bool ends_source(int error) noexcept {
  return error == EBADF || error == ENOTSOCK || error == EFAULT || error == EINVAL;
}

Event UdpSource::receive(Reception& into, std::chrono::nanoseconds wait) {
  const Deadline deadline(wait);
  for (;;) {
    if (stop_.is_set()) return Event::stopped;
    if (counts_.error != 0) return Event::failed;
    while (next_ < count_) {
      if (const auto event = judge(next_++, into)) return *event;
    }
    const int came = batch_.fill(bound_.socket.get());
    next_ = 0;
    count_ = came > 0 ? static_cast<std::size_t>(came) : 0;
    if (came > 0 || (came < 0 && errno == EINTR)) continue;
    if (came < 0 && ends_source(errno)) return fail(errno);
    switch (wait_readable(bound_.socket.get(), stop_, deadline)) {
      case Wake::readable:
        // With no time to wait, what is there was asked for already.
        if (!deadline.is_endless() && deadline.left() == std::chrono::nanoseconds::zero()) return Event::idle;
        break;
      case Wake::stopped:
        return Event::stopped;
      case Wake::timeout:
        return Event::idle;
      case Wake::failed:
        return fail(errno);
    }
  }
}

std::optional<Event> UdpSource::judge(std::size_t i, Reception& into) noexcept {
  const Sender sender = batch_.sender(i);
  if (!is_allowed(sender)) {
    ++counts_.refused;
    counts_.last_refused = sender;
    published_.store(counts_);
    return {};
  }
  into.sample.sender = sender;
  into.sample.arrival = batch_.arrival(i);
  const auto decoded = batch_.was_longer(i) ? tl::make_unexpected(wire::Fault{wire::Reason::too_long})
                                            : layouts_.decode(batch_.datagram(i), sender);
  if (!decoded) {
    into.fault = decoded.error();
    ++counts_.malformed;
    published_.store(counts_);
    return Event::malformed;
  }
  into.sample.record = decoded->record;
  into.sample.form = decoded->form;
  ++counts_.records;
  const auto* params = std::get_if<wire::CameraParams>(&decoded->record);
  if (params != nullptr && (params->format & ~wire::known_format_bits) != 0) ++counts_.unknown_format_bits;
  published_.store(counts_);
  return Event::sample;
}

Event UdpSource::fail(int error) noexcept {
  counts_.error = error;
  published_.store(counts_);
  return Event::failed;
}

SourceStatistics UdpSource::statistics() const {
  const Counts counts = published_.load();
  SourceStatistics s;
  s.records = counts.records;
  s.malformed = counts.malformed;
  s.refused = counts.refused;
  s.unknown_format_bits = counts.unknown_format_bits;
  s.last_refused = counts.last_refused;
  s.kernel_drops = dropped_by_kernel(bound_.socket.get()).value_or(0);
  if (counts.error != 0) {
    s.state = SourceState::failed;
    s.error = name_ + ": " + system_text(counts.error);
  } else if (counts.records > 0) {
    s.state = SourceState::receiving;
  } else if (counts.malformed > 0) {
    s.state = SourceState::nothing_valid;
  } else if (counts.refused > 0) {
    s.state = SourceState::only_refused;
  } else {
    s.waiting_for =
        "udp port " + std::to_string(sender_of(bound_.address.storage).number) + ": bound, nothing received yet";
  }
  return s;
}

}  // namespace

std::unique_ptr<Source> open_udp_source(const UdpEndpoint& endpoint) {
  try {
    return std::make_unique<UdpSource>(endpoint);
  } catch (const TransportError& error) {
    throw TransportError(udp_url(endpoint.host, endpoint.port) + ": " + error.what());
  }
}

}  // namespace trk_bridge::transport
