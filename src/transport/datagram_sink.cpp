// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "base/system_text.h"
#include "datagram.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/clock.h"
#include "base/number_text.h"
#include "interfaces.h"
#include "scheme.h"
#include "socket.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {
namespace {

using std::chrono::steady_clock;

void set_ttl(int fd, const SocketAddress& target, int ttl) {
  const bool group = is_multicast(target);
  if (target.family() == AF_INET) {
    set_option(fd, IPPROTO_IP, group ? IP_MULTICAST_TTL : IP_TTL, ttl, "ttl");
  } else {
    set_option(fd, IPPROTO_IPV6, group ? IPV6_MULTICAST_HOPS : IPV6_UNICAST_HOPS, ttl, "ttl");
  }
}

Descriptor open_socket_to(const SocketAddress& target, const SendSettings& settings) {
  Descriptor socket(::socket(target.family(), SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.is_open()) throw TransportError("no socket: " + base::system_text(errno));
  const int fd = socket.get();
  // Always set: whether the target is a broadcast address changes with the interfaces.
  if (target.family() == AF_INET) set_option(fd, SOL_SOCKET, SO_BROADCAST, 1, "broadcast");
  if (settings.ttl) set_ttl(fd, target, *settings.ttl);
  const bool group = is_multicast(target);
  if (group && target.family() == AF_INET)
    set_option(fd, IPPROTO_IP, IP_MULTICAST_LOOP, 1, "multicast to this machine");
  if (group && target.family() == AF_INET6) {
    set_option(fd, IPPROTO_IPV6, IPV6_MULTICAST_LOOP, 1, "multicast to this machine");
  }
  if (!settings.interface.empty() && !group) {
    throw TransportError("interface = \"" + settings.interface +
                         "\" is for multicast: for other addresses, the routes of the system decide");
  }
  return socket;
}

SocketAddress target_of(const SendSettings& settings) {
  const SocketAddress target = resolve(settings.host, settings.port).front();
  if (is_any(target)) throw TransportError("host \"" + settings.host + "\" is not an address to send to");
  if (settings.port == 0) throw TransportError("port = 0: allowed for writing is a whole number from 1 to 65535");
  return target;
}

steady_clock::duration period_of(const SendSettings& settings) {
  const double seconds = settings.constants_period;
  if (!(seconds >= 0.0 && seconds <= 86400.0)) {
    throw TransportError("constants_period = " + base::number_text(seconds) + ": allowed are seconds from 0 to 86400");
  }
  return std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
}

class DatagramSink final : public Sink {
 public:
  DatagramSink(const SendSettings& settings, std::unique_ptr<Encoder> encoder)
      : target_(target_of(settings)),
        socket_(open_socket_to(target_, settings)),
        interface_(interface_of(settings.host, settings.interface)),
        name_("udp to " + to_string(sender_of(target_.storage)) + (interface_.empty() ? "" : " through " + interface_)),
        encoder_(std::move(encoder)),
        period_(period_of(settings)) {
    if (interface_.empty()) return;
    watch_.emplace();
    follow_interface();
    watch_->start([this](const InterfaceWatch::Removed&) { return follow_interface_or_wait(); });
  }

  std::string name() const override { return name_; }

 private:
  /// The constants of one camera.
  struct Remembered {
    wire::CameraConstants constants;
    std::optional<steady_clock::time_point> last_sent;  // none: not sent yet
  };

  WriteResult put(const wire::CameraParams& params) override;
  WriteResult put(const wire::CameraConstants& constants) override;
  WriteResult finish() override {
    watch_.reset();
    socket_.close();
    return {};
  }
  void follow_interface();
  bool follow_interface_or_wait() noexcept;
  template <typename Record>
  WriteResult send(const Record& record) noexcept;
  WriteResult send_datagram(std::string_view datagram) noexcept;

  const SocketAddress target_;
  Descriptor socket_;
  const std::string interface_;  // the interface that must be used; empty: the system decides
  const std::string name_;
  std::unique_ptr<Encoder> encoder_;
  const steady_clock::duration period_;
  std::unordered_map<std::uint32_t, Remembered> remembered_;  // by id

  std::atomic<bool> can_send_{true};     // false while the interface cannot be used
  std::optional<InterfaceWatch> watch_;  // must be the last member: its thread uses the others
};

void DatagramSink::follow_interface() {
  const auto interface = find_interface(interface_);
  // If the interface has no address, the kernel sends IPv4 from 0.0.0.0, which no receiver accepts.
  const bool has_address = interface && (target_.family() != AF_INET || interface->has_ipv4);
  can_send_ = has_address && send_through(socket_.get(), target_, *interface);
}

bool DatagramSink::follow_interface_or_wait() noexcept {
  try {
    follow_interface();
    return true;
  } catch (const TransportError&) {
    // Keeps the last known state of the interface.
    return false;
  }
}

WriteResult DatagramSink::send_datagram(std::string_view datagram) noexcept {
  if (!can_send_) return refused(SinkReason::no_interface);
  ssize_t written;
  do {
    // Not connected: otherwise an unreachable receiver would make the next datagram fail.
    written = ::sendto(socket_.get(), datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL, target_.get(),
                       target_.length);
  } while (written < 0 && errno == EINTR);
  if (written < 0) return refused_by_system(errno);
  return {};
}

template <typename Record>
WriteResult DatagramSink::send(const Record& record) noexcept {
  if (const auto begun = encoder_->begin(record); !begun) {
    return tl::make_unexpected(SinkFault{SinkReason::not_encodable, begun.error()});
  }
  while (const auto datagram = encoder_->next()) {
    if (auto sent = send_datagram(*datagram); !sent) return sent;
  }
  return {};
}

WriteResult DatagramSink::put(const wire::CameraParams& params) {
  WriteResult constants_sent;
  if (const auto found = remembered_.find(params.id); found != remembered_.end()) {
    Remembered& remembered = found->second;
    const auto now = steady_clock::now();
    const bool is_due = !remembered.last_sent || now - *remembered.last_sent >= period_;
    if (period_ > steady_clock::duration::zero() && is_due) {
      constants_sent = send(remembered.constants);
      if (constants_sent) {
        remembered.last_sent = now;
        count_constants();
      }
    }
  }
  encoder_->use_time(time().nanoseconds != 0 ? time().nanoseconds : base::wall_now(), time().time_code);
  const WriteResult params_sent = send(params);
  if (!params_sent) return params_sent;
  // Because of the fault of the constants, write() does not count the parameters.
  if (!constants_sent) count_params();
  return constants_sent;
}

WriteResult DatagramSink::put(const wire::CameraConstants& constants) {
  const WriteResult sent = send(constants);
  // Constants that can never be sent are not repeated.
  if (!sent && sent.error().reason == SinkReason::not_encodable) return sent;
  Remembered& remembered = remembered_[constants.id];
  remembered.constants = constants;
  remembered.last_sent.reset();
  if (sent) remembered.last_sent = steady_clock::now();
  return sent;
}

}  // namespace

std::unique_ptr<Sink> open_datagram_sink(const SendSettings& settings, std::unique_ptr<Encoder> encoder) {
  try {
    return std::make_unique<DatagramSink>(settings, std::move(encoder));
  } catch (const TransportError& error) {
    throw TransportError(udp_url(settings.host, settings.port) + ": " + error.what());
  }
}

}  // namespace trk_bridge::transport
