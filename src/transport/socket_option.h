// Setting an option of a socket, or saying which could not be set.
#pragma once

#include <sys/socket.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

/// Throws TransportError: "`what`: the system refused: …".
template <typename T>
void set_option(int fd, int level, int option, const T& value, const char* what) {
  if (::setsockopt(fd, level, option, &value, sizeof value) == 0) return;
  throw TransportError(std::string(what) + ": the system refused: " + std::generic_category().message(errno));
}

}  // namespace trk_bridge::transport
