#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <memory>
#include <system_error>
#include <unordered_map>

#include "backends.h"
#include "descriptor.h"
#include "multicast.h"
#include "socket_address.h"
#include "socket_option.h"
#include "trk_bridge/transport/snapshot.h"
#include "url.h"

namespace trk_bridge::transport {

namespace {

using std::chrono::steady_clock;

// What everything in use today speaks.
constexpr wire::Layout default_layout{wire::Generation::identified, wire::Abi::lp64, wire::ByteOrder::little};

wire::WireForm form_of(const UdpEndpoint& endpoint) {
  if (!endpoint.binary) return {};
  return {wire::Encoding::binary, wire::resolve(endpoint.layout, default_layout)};
}

void set_ttl(int fd, const SocketAddress& target, int ttl) {
  const bool group = is_multicast(target);
  if (target.family() == AF_INET) {
    set_option(fd, IPPROTO_IP, group ? IP_MULTICAST_TTL : IP_TTL, ttl, "ttl");
  } else {
    set_option(fd, IPPROTO_IPV6, group ? IPV6_MULTICAST_HOPS : IPV6_UNICAST_HOPS, ttl, "ttl");
  }
}

Descriptor open_socket_to(const SocketAddress& target, const UdpEndpoint& endpoint) {
  Descriptor socket(::socket(target.family(), SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.is_open()) throw TransportError("no socket: " + std::generic_category().message(errno));
  const int fd = socket.get();
  if (is_broadcast(target)) set_option(fd, SOL_SOCKET, SO_BROADCAST, 1, "broadcast");
  if (endpoint.ttl) set_ttl(fd, target, *endpoint.ttl);
  const bool group = is_multicast(target);
  if (group && target.family() == AF_INET)
    set_option(fd, IPPROTO_IP, IP_MULTICAST_LOOP, 1, "multicast to this machine");
  if (group && target.family() == AF_INET6) {
    set_option(fd, IPPROTO_IPV6, IPV6_MULTICAST_LOOP, 1, "multicast to this machine");
  }
  if (endpoint.interface.empty()) return socket;
  if (!group) {
    throw TransportError("interface = \"" + endpoint.interface +
                         "\" is for multicast: to one address the system's routes lead");
  }
  send_through(fd, target.family(), find_interface(endpoint.interface));
  return socket;
}

SocketAddress target_of(const UdpEndpoint& endpoint) {
  const SocketAddress target = resolve(endpoint.host, endpoint.port).front();
  if (is_any(target)) throw TransportError("host \"" + endpoint.host + "\" is no address to send to");
  if (endpoint.port == 0) throw TransportError("port = 0: allowed for writing is a whole number from 1 to 65535");
  return target;
}

steady_clock::duration period_of(const UdpEndpoint& endpoint) {
  const double seconds = endpoint.constants_period;
  if (!(seconds >= 0.0 && seconds <= 86400.0)) {
    throw TransportError("constants_period = " + std::to_string(seconds) + ": allowed are seconds from 0 to 86400");
  }
  return std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
}

class UdpSink final : public Sink {
 public:
  explicit UdpSink(const UdpEndpoint& endpoint)
      : target_(target_of(endpoint)),
        socket_(open_socket_to(target_, endpoint)),
        name_("udp to " + to_string(sender_of(target_.storage))),
        form_(form_of(endpoint)),
        resend_equal_(endpoint.resend_equal),
        period_(period_of(endpoint)) {}

  tl::expected<void, SinkFault> write(const wire::CameraParams& params) override;
  tl::expected<void, SinkFault> write(const wire::CameraConstants& constants) override;

  tl::expected<void, SinkFault> close() override {
    socket_.close();
    return {};
  }

  SinkStatistics statistics() const override { return published_.load(); }
  std::string name() const override { return name_; }

 private:
  /// The constants of one camera.
  struct Remembered {
    wire::CameraConstants constants;
    bool pending = true;  // they have not gone out yet
    steady_clock::time_point last_sent{};
  };

  template <typename Record>
  tl::expected<void, SinkFault> send(const Record& record, std::uint64_t SinkStatistics::*sent) noexcept;
  tl::expected<void, SinkFault> send_remembered(Remembered& remembered, steady_clock::time_point now) noexcept;
  tl::expected<void, SinkFault> refuse(const SinkFault& fault) noexcept;

  const SocketAddress target_;
  Descriptor socket_;
  const std::string name_;
  const wire::WireForm form_;
  const bool resend_equal_;
  const steady_clock::duration period_;
  std::unordered_map<std::uint32_t, Remembered> remembered_;  // by id
  wire::Buffer buffer_{};
  SinkStatistics counts_;
  Snapshot<SinkStatistics> published_;
};

tl::expected<void, SinkFault> UdpSink::refuse(const SinkFault& fault) noexcept {
  ++counts_.errors;
  published_.store(counts_);
  return tl::make_unexpected(fault);
}

template <typename Record>
tl::expected<void, SinkFault> UdpSink::send(const Record& record, std::uint64_t SinkStatistics::*sent) noexcept {
  const auto datagram = wire::encode(record, form_, buffer_);
  if (!datagram) return refuse({SinkReason::not_encodable, datagram.error()});
  ssize_t written;
  do {
    // The socket is not connected: a receiver that is not there is none of a later datagram's concern.
    written = ::sendto(socket_.get(), datagram->data(), datagram->size(), MSG_DONTWAIT | MSG_NOSIGNAL, target_.get(),
                       target_.length);
  } while (written < 0 && errno == EINTR);
  if (written < 0) {
    SinkFault fault{SinkReason::system};
    fault.error_number = errno;
    return refuse(fault);
  }
  ++(counts_.*sent);
  published_.store(counts_);
  return {};
}

tl::expected<void, SinkFault> UdpSink::send_remembered(Remembered& remembered, steady_clock::time_point now) noexcept {
  const auto sent = send(remembered.constants, &SinkStatistics::constants);
  if (sent) {
    remembered.pending = false;
    remembered.last_sent = now;
  }
  return sent;
}

tl::expected<void, SinkFault> UdpSink::write(const wire::CameraParams& params) {
  if (!socket_.is_open()) return refuse({SinkReason::closed});
  tl::expected<void, SinkFault> constants_sent;
  if (const auto found = remembered_.find(params.id); found != remembered_.end()) {
    Remembered& remembered = found->second;
    const auto now = steady_clock::now();
    const bool due = period_ > steady_clock::duration::zero() && now - remembered.last_sent >= period_;
    if (remembered.pending || due) constants_sent = send_remembered(remembered, now);
  }
  const auto params_sent = send(params, &SinkStatistics::params);
  return params_sent ? constants_sent : params_sent;
}

tl::expected<void, SinkFault> UdpSink::write(const wire::CameraConstants& constants) {
  if (!socket_.is_open()) return refuse({SinkReason::closed});
  // What can never go out is not worth remembering.
  if (const auto encoded = wire::encode(constants, form_, buffer_); !encoded) {
    return refuse({SinkReason::not_encodable, encoded.error()});
  }
  const auto [found, is_new] = remembered_.try_emplace(constants.id, Remembered{constants});
  Remembered& remembered = found->second;
  const bool known = !is_new && !remembered.pending && remembered.constants == constants;
  if (known && !resend_equal_) return {};
  remembered.constants = constants;
  remembered.pending = true;
  return send_remembered(remembered, steady_clock::now());
}

}  // namespace

std::unique_ptr<Sink> open_udp_sink(const UdpEndpoint& endpoint) {
  try {
    return std::make_unique<UdpSink>(endpoint);
  } catch (const TransportError& error) {
    throw TransportError(udp_url(endpoint.host, endpoint.port) + ": " + error.what());
  }
}

}  // namespace trk_bridge::transport
