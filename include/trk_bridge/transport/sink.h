// Where records go: one interface over UDP, shared memory, files and memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/transport/endpoint.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::transport {

/// What kind of fault it is.
enum class SinkReason : std::uint8_t {
  not_encodable,      ///< `fault` says which field
  no_constants,       ///< a file begins with constants: none were written before the first parameters
  constants_changed,  ///< a file holds one set of constants: others came, or parameters that belong to them
  other_camera,       ///< a file holds one camera: the id is not that of its constants
  system,             ///< the kernel refused: `error_number`
  gone,               ///< the segment was removed; the sink tries to make it anew at the next write
  closed,             ///< close() was called before
};

/// Why a write or a close failed.
struct SinkFault {
  SinkReason reason;
  wire::Fault fault{wire::Reason::truncated};
  int error_number = 0;
};
std::string describe(const SinkFault&);

/// What went out so far.
struct SinkStatistics {
  std::uint64_t params = 0, constants = 0;  ///< records that went out, repeated constants counted
  std::uint64_t errors = 0;
};

/// Writes never block on a receiver and never lose what is written before or after a failed one. One thread at a time.
class Sink {
 public:
  virtual ~Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  /// Sends one set of parameters, and before it the constants of the same id when their period has passed.
  [[nodiscard]] virtual tl::expected<void, SinkFault> write(const wire::CameraParams&) = 0;
  /// Sends constants if they differ from the last ones of that id, and remembers them for repeating.
  [[nodiscard]] virtual tl::expected<void, SinkFault> write(const wire::CameraConstants&) = 0;
  /// Ends orderly: what is buffered goes out, a file gets its final name. The destructor does it, too, but cannot say
  /// how it went.
  [[nodiscard]] virtual tl::expected<void, SinkFault> close() = 0;

  virtual SinkStatistics statistics() const = 0;
  virtual std::string name() const = 0;

 protected:
  Sink() = default;
};

/// The only place that makes sinks. Throws TransportError.
std::unique_ptr<Sink> open_sink(const Endpoint&);
std::unique_ptr<Sink> open_sink(std::string_view url);

}  // namespace trk_bridge::transport
