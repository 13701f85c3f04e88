// Waiting in the kernel for something to read, until a time, or until stopped.
#pragma once

#include <chrono>

#include "stop_event.h"

namespace trk_bridge::transport {

/// A moment from now on; `wait` as in Source::receive.
class Deadline {
 public:
  explicit Deadline(std::chrono::nanoseconds wait) noexcept;

  bool is_endless() const noexcept { return endless_; }
  /// Not below zero.
  std::chrono::nanoseconds left() const noexcept;

 private:
  bool endless_;
  std::chrono::steady_clock::time_point at_{};
};

enum class Wake { readable, stopped, timeout, failed };

/// `readable` also when the descriptor has an error to tell; `failed` leaves the reason in errno.
[[nodiscard]] Wake wait_readable(int fd, const StopEvent& stop, const Deadline& deadline) noexcept;

}  // namespace trk_bridge::transport
