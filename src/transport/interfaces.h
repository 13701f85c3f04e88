// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The network interfaces of the machine: their list, multicast through them, and their changes.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <netinet/in.h>

#include "socket.h"
#include "waiting.h"

namespace trk_bridge::transport {

/// An existing interface.
struct Interface {
  unsigned index = 0;
  bool is_up = false;
  bool has_ipv4 = false;  ///< an IPv4 address
  in_addr ipv4{};         ///< the address that named it; 0.0.0.0 if it was named otherwise
};

/// Whether the text is a possible interface name or an address, even if no interface has it.
bool is_interface_name_or_address(const std::string& text);

/// The interface that an endpoint must use: `interface`, else the zone of the host; empty: none. Throws TransportError
/// if the zone cannot be an interface.
std::string interface_of(const std::string& host, const std::string& interface);

/// Finds an interface by its address, name or number. Throws TransportError if the system does not list the interfaces.
std::optional<Interface> find_interface(const std::string& named);

/// Why it cannot be used: "no interface has the address or name eth7; there are lo, eth0", "interface eth0 is down";
/// empty if it can. Throws as find_interface().
std::string why_unusable(const std::string& named);

/// The interfaces that are up, support multicast or are the loopback, and have an address of the family. Throws as
/// find_interface().
std::vector<unsigned> multicast_interfaces(int family);

/// Joins or leaves `group` on one interface. An interface that was just removed is not an error: false, and nothing is
/// joined. Throws TransportError.
bool join_group(int fd, const SocketAddress& group, unsigned index);
void leave_group(int fd, const SocketAddress& group, unsigned index) noexcept;

/// Receives only groups that this socket joined, not those that other sockets joined on the same interfaces. Throws
/// TransportError.
void receive_joined_only(int fd, int family);

/// Makes a socket that is not bound send to `target` through the interface. False if the interface was just removed.
bool send_through(int fd, const SocketAddress& target, const Interface& interface) noexcept;

/// Waits in its own thread for changes of interfaces and their addresses. Listing interfaces and joining groups can
/// block in the kernel while another interface is configured; this must not delay samples.
class InterfaceWatch {
 public:
  /// Interfaces that were removed since the previous call.
  struct Removed {
    std::vector<unsigned> indices;
    bool maybe_others = false;  ///< the queue of the kernel overflowed

    /// Whether the interface was removed; its number may already belong to a new one.
    bool has(unsigned index) const {
      return maybe_others || std::find(indices.begin(), indices.end(), index) != indices.end();
    }
  };
  /// Called in the thread of the watch after one or more changes. If it returns false, it is called again after a
  /// second at the latest.
  using Follow = std::function<bool(const Removed&)>;

  /// Changes after this call are not missed. Throws TransportError.
  InterfaceWatch();
  ~InterfaceWatch();
  InterfaceWatch(const InterfaceWatch&) = delete;
  InterfaceWatch& operator=(const InterfaceWatch&) = delete;

  void start(Follow follow);

 private:
  void run();
  Removed read_changes();

  Descriptor changes_;
  StopEvent stop_;
  Follow follow_;
  std::thread thread_;
};

}  // namespace trk_bridge::transport
