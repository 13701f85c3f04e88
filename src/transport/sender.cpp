#include "trk_bridge/transport/sender.h"

#include <arpa/inet.h>

namespace trk_bridge::transport {

namespace {

std::string address_text(int family, const Sender& sender) {
  char text[INET6_ADDRSTRLEN] = "";
  ::inet_ntop(family, sender.address.data(), text, sizeof text);
  return text;
}

}  // namespace

std::string to_string(const Sender& sender) {
  switch (sender.kind) {
    case SenderKind::none:
      return "-";
    case SenderKind::ipv4:
      return address_text(AF_INET, sender) + ":" + std::to_string(sender.number);
    case SenderKind::ipv6:
      return "[" + address_text(AF_INET6, sender) + "]:" + std::to_string(sender.number);
    case SenderKind::shm:
      return "slot " + std::to_string(sender.number);
    case SenderKind::file:
      return "file";
    case SenderKind::memory:
      return "memory";
  }
  return "-";
}

}  // namespace trk_bridge::transport
