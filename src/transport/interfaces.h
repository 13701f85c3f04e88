// The machine's network interfaces: which there are, multicast through them, and their coming and going.
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

/// An interface that is there.
struct Interface {
  unsigned index = 0;
  bool is_up = false;
  bool has_ipv4 = false;  ///< an IPv4 address
  in_addr ipv4{};         ///< the address it was named by; 0.0.0.0 when by name or IPv6 address
};

/// Whether the text can be an interface's name or an address, whatever interfaces there are.
bool may_name_interface(const std::string& text);

/// The interface that an endpoint is tied to: `interface`, else the zone of the host; empty: none. Throws
/// TransportError when the zone can be none.
std::string interface_of(const std::string& host, const std::string& interface);

/// By an address it has, by its name, or by its number. Throws TransportError when the system does not list them.
std::optional<Interface> find_interface(const std::string& named);

/// Why nothing comes or goes through it: "no interface has the address or name eth7; there are lo, eth0", "interface
/// eth0 is down"; empty where neither is so. Throws as find_interface().
std::string why_no_way_through(const std::string& named);

/// Those that are up, can do multicast or are the loopback, and have an address of the family. Throws as
/// find_interface().
std::vector<unsigned> multicast_interfaces(int family);

/// Joins or leaves `group` on one interface. An interface that has just gone is no error: nothing is joined.
/// Throws TransportError.
bool join_group(int fd, const SocketAddress& group, unsigned index);
void leave_group(int fd, const SocketAddress& group, unsigned index) noexcept;

/// Only what was joined is heard, not what others joined on the same interfaces. Throws TransportError.
void hear_joined_only(int fd, int family);

/// What a socket that is not bound sends to `target` goes through the interface. False when it has just gone.
bool send_through(int fd, const SocketAddress& target, const Interface& interface) noexcept;

/// Waits for changes of interfaces and their addresses in a thread of its own: the kernel lets one who asks for or
/// joins interfaces wait while another is configured, and no sample may wait for that.
class InterfaceWatch {
 public:
  /// Interfaces that were removed since the call before.
  struct Removed {
    std::vector<unsigned> indices;
    bool maybe_others = false;  ///< the kernel had more to say than its queue holds

    /// The number may be that of a new interface by now.
    bool has(unsigned index) const {
      return maybe_others || std::find(indices.begin(), indices.end(), index) != indices.end();
    }
  };
  /// Called in the watch's thread after one or more changes; false: again after a second at the latest.
  using Follow = std::function<bool(const Removed&)>;

  /// What changes from here on is not missed. Throws TransportError.
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
