#include "stop_event.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

#include <sys/eventfd.h>
#include <unistd.h>

#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

StopEvent::StopEvent() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (fd_ < 0) throw TransportError(std::string("no descriptor for waiting: ") + std::strerror(errno));
}

StopEvent::~StopEvent() { ::close(fd_); }

void StopEvent::set() noexcept {
  const int saved = errno;
  set_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  // The only way to fail is a full counter, and then the descriptor is readable already.
  [[maybe_unused]] const ssize_t written = ::write(fd_, &one, sizeof one);
  errno = saved;
}

}  // namespace trk_bridge::transport
