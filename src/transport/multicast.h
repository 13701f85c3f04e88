// Multicast groups and the interfaces that they are heard and sent through.
#pragma once

#include <netinet/in.h>

#include <string>

#include "socket_address.h"

namespace trk_bridge::transport {

struct Interface {
  unsigned index = 0;
  in_addr ipv4{};  ///< the address it was named by; 0.0.0.0 when by name or IPv6 address
};

/// By an address it has or by its name. Throws TransportError that lists what there is.
Interface find_interface(const std::string& address_or_name);

/// Hears `group` through the interface named, else that of the address's zone, else every one that is up and can do
/// multicast, and the loopback; and nothing through others, whoever joined it there. Throws TransportError.
void join_group(int fd, const SocketAddress& group, const std::string& interface);

/// Sends to groups through the interface. Throws TransportError.
void send_through(int fd, int family, const Interface& interface);

}  // namespace trk_bridge::transport
