// Where records go: one interface over datagrams, shared memory and files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "trk_bridge/base/snapshot.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::transport {

/// What kind of fault it is.
enum class SinkReason : std::uint8_t {
  not_encodable,      ///< `fault` says why
  no_constants,       ///< a file begins with constants: none were written before the first parameters
  constants_changed,  ///< a file holds one set of constants: others came, or parameters that belong to them
  other_camera,       ///< a file holds one camera: the id is not that of its constants
  system,             ///< the kernel refused: `error_number`
  no_interface,       ///< the interface to send through is not there or has no address; writes go out when it has
  gone,               ///< no segment can be written to: every write looks for one, or creates it
  closed,             ///< close() was called before
  exists,             ///< a file of that name is there, and overwriting was not asked for
  left_over,          ///< a `.part` is there that an interrupted writer left
  in_use,             ///< another writer writes to the same name
  not_a_file,         ///< the name is that of something that is neither an ordinary file nor a FIFO
  no_reader,          ///< no program reads the FIFO
  no_free_number,     ///< every number that a name can have is taken
  no_answer,          ///< a write or the end took too long and was not waited for
};

/// Why a write or a close failed. Trivially copyable.
struct SinkFault {
  SinkReason reason{};
  Fault fault{};         ///< counts with not_encodable
  int error_number = 0;  ///< counts with system
};
bool operator==(const SinkFault&, const SinkFault&) noexcept;
bool operator<(const SinkFault&, const SinkFault&) noexcept;
/// One line for a person.
std::string describe(const SinkFault&);

/// What went out so far. Trivially copyable.
struct SinkStatistics {
  std::uint64_t params = 0, constants = 0;  ///< records that went out, repeated constants counted
  std::uint64_t errors = 0;
};

/// When a record was true.
struct RecordTime {
  // NOLINTNEXTLINE(google-explicit-constructor): a time is one without a code
  RecordTime(std::int64_t since_1970 = 0, std::optional<base::CountedTimeCode> code = {}) noexcept
      : nanoseconds(since_1970), time_code(code) {}

  std::int64_t nanoseconds;  ///< since 1970 UTC; 0: now
  std::optional<base::CountedTimeCode> time_code;
};

/// What a write or a close gives.
using Written = tl::expected<void, SinkFault>;
/// For functions that give a fault.
inline tl::unexpected<SinkFault> refused(SinkReason reason) noexcept { return tl::unexpected(SinkFault{reason}); }
/// Likewise, of an errno.
inline tl::unexpected<SinkFault> refused_by_system(int error_number) noexcept {
  return tl::unexpected(SinkFault{SinkReason::system, {}, error_number});
}

/// One place that records go to. What is written before or after a failed write is not lost by it. One thread at a
/// time, but for statistics(), name() and notice().
///
/// Whether constants are new is the caller's matter (camera::Converter knows): a sink writes what it is given.
/// Receivers of datagrams that join late would never see constants, so that datagram sinks repeat them by themselves.
class Sink {
 public:
  virtual ~Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  /// Does what the first write would do first, so that it is known before whether records can go out: a file is
  /// created, a segment attached or created. May block. Throws TransportError with the reason; a later write, or this
  /// function called again, tries again. Does nothing where it is done.
  void prepare();
  /// Writes one set of parameters; a datagram sink sends the constants of the same id before it when their period has
  /// passed.
  [[nodiscard]] Written write(const wire::CameraParams&, const RecordTime& time = {});
  [[nodiscard]] Written write(const wire::CameraConstants&);
  /// Ends in order: a file gets its final name. Closing again does nothing. A sink that is destroyed without it ends
  /// likewise, but cannot report how that went.
  [[nodiscard]] Written close();

  /// A consistent snapshot. Any thread.
  SinkStatistics statistics() const noexcept { return published_.load(); }
  /// The endpoint as a person reads it: "udp to 192.0.2.7:7000", "shm slot 7", "file take.trk". Any thread: a file that
  /// is named by the time of its first field has its name from then on.
  virtual std::string name() const = 0;
  /// What a person should know though nothing is wrong: recordings that were recovered. Any thread.
  virtual std::string notice() const { return {}; }

 protected:
  Sink() = default;
  /// Counts constants that were repeated.
  void count_constants() noexcept { ++counts_.constants; }
  /// Counts parameters that went out though put() gives a fault.
  void count_params() noexcept { ++counts_.params; }
  /// Of the parameters that put() is given.
  const RecordTime& time() const noexcept { return time_; }

 private:
  virtual void get_ready() {}
  virtual Written put(const wire::CameraParams&) = 0;
  virtual Written put(const wire::CameraConstants&) = 0;
  virtual Written finish() = 0;
  Written counted(const Written&, std::uint64_t& good) noexcept;

  bool closed_ = false;
  RecordTime time_;
  SinkStatistics counts_;
  base::Snapshot<SinkStatistics> published_;
};

}  // namespace trk_bridge::transport
