// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Plain sockets on the loopback, as of a tracker or a receiver.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "camera_records.h"
#include "deadline.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::test {

/// A socket bound to an address of the loopback and a port that the kernel picks.
class PlainSocket {
 public:
  explicit PlainSocket(const std::string& address = "127.0.0.1") : ipv6_(address.find(':') != std::string::npos) {
    fd_ = ::socket(ipv6_ ? AF_INET6 : AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const sockaddr_storage storage = make(address, 0);
    const int yes = 1;
    if (fd_ < 0 || ::setsockopt(fd_, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes) != 0 ||
        ::bind(fd_, reinterpret_cast<const sockaddr*>(&storage), length()) != 0) {
      throw std::runtime_error("no socket on " + address);
    }
  }
  ~PlainSocket() { ::close(fd_); }
  PlainSocket(const PlainSocket&) = delete;
  PlainSocket& operator=(const PlainSocket&) = delete;

  int fd() const { return fd_; }

  std::uint16_t port() const {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&storage), &size);
    return ntohs(ipv6_ ? reinterpret_cast<sockaddr_in6&>(storage).sin6_port
                       : reinterpret_cast<sockaddr_in&>(storage).sin_port);
  }

  void send(std::string_view datagram, const std::string& address, std::uint16_t to_port) const {
    const sockaddr_storage storage = make(address, to_port);
    const ssize_t sent =
        ::sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&storage), length());
    ASSERT_EQ(sent, static_cast<ssize_t>(datagram.size())) << std::strerror(errno);
  }

  /// The next datagram within the deadline; within `wait` when given.
  std::optional<std::string> receive(std::chrono::milliseconds wait = deadline) const {
    pollfd watched{fd_, POLLIN, 0};
    if (::poll(&watched, 1, static_cast<int>(wait.count())) != 1) return {};
    std::string datagram(65536, '\0');
    const ssize_t size = ::recv(fd_, datagram.data(), datagram.size(), 0);
    if (size < 0) return {};
    datagram.resize(static_cast<std::size_t>(size));
    return datagram;
  }

 private:
  socklen_t length() const { return ipv6_ ? sizeof(sockaddr_in6) : sizeof(sockaddr_in); }

  sockaddr_storage make(const std::string& address, std::uint16_t to_port) const {
    sockaddr_storage storage{};
    if (ipv6_) {
      auto& to = reinterpret_cast<sockaddr_in6&>(storage);
      to.sin6_family = AF_INET6;
      to.sin6_port = htons(to_port);
      ::inet_pton(AF_INET6, address.c_str(), &to.sin6_addr);
    } else {
      auto& to = reinterpret_cast<sockaddr_in&>(storage);
      to.sin_family = AF_INET;
      to.sin_port = htons(to_port);
      ::inet_pton(AF_INET, address.c_str(), &to.sin_addr);
    }
    return storage;
  }

  bool ipv6_;
  int fd_;
};

/// The port in the name of a UDP source.
inline std::uint16_t udp_port_in(const std::string& name) {
  const std::string before = "udp port ";
  if (name.compare(0, before.size(), before) != 0) throw std::runtime_error("no port in \"" + name + "\"");
  return static_cast<std::uint16_t>(std::stoi(name.substr(before.size())));
}

inline std::uint16_t port_of(const transport::Source& source) { return udp_port_in(source.name()); }

template <typename Record>
std::string datagram(const Record& record, wire::WireForm form = {}) {
  wire::Buffer buffer;
  const auto bytes = wire::encode(record, form, buffer);
  if (!bytes) throw std::runtime_error(wire::describe(bytes.error()));
  return std::string(*bytes);
}

/// The next event of the source within the deadline.
inline transport::Event next(transport::Source& source, transport::Reception& reception) {
  return source.receive(reception, deadline);
}

/// The counter of the next record, which must be parameters.
inline std::optional<std::uint64_t> next_counter(transport::Source& source) {
  transport::Reception reception;
  if (next(source, reception) != transport::Event::sample) return {};
  const auto* p = std::get_if<wire::CameraParams>(&reception.sample.record);
  if (p == nullptr) return {};
  return p->counter;
}

}  // namespace trk_bridge::test
