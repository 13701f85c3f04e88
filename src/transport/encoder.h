// What a protocol makes of records.
#pragma once

#include <optional>
#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/transport/fault.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::transport {

/// Records to datagrams. Not synchronised; does not allocate while records come.
class Encoder {
 public:
  virtual ~Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// The record whose datagrams next() gives from now on.
  [[nodiscard]] virtual tl::expected<void, Fault> begin(const wire::CameraParams&) noexcept = 0;
  [[nodiscard]] virtual tl::expected<void, Fault> begin(const wire::CameraConstants&) noexcept = 0;
  /// The next datagram, which holds until the call after; none when all have been given.
  virtual std::optional<std::string_view> next() noexcept = 0;

 protected:
  Encoder() = default;
};

}  // namespace trk_bridge::transport
