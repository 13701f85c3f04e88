// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Sinks: one interface for writing datagrams, shared memory and files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "trk_bridge/base/snapshot.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::transport {

/// The kind of a fault.
enum class SinkReason : std::uint8_t {
  not_encodable,      ///< `fault` says why
  no_constants,       ///< a file begins with constants, but parameters were written first
  constants_changed,  ///< a file has one set of constants: other ones were written, or parameters that belong to them
  other_camera,       ///< a file has one camera: the id is not that of its constants
  system,             ///< the kernel refused: `error_number`
  no_interface,  ///< the interface to send through does not exist or has no address; sending continues when it has one
  no_segment,    ///< there is no segment to write to: every write looks for one, or creates it
  closed,        ///< close() was called before
  exists,        ///< the file exists, and overwriting was not requested
  part_exists,   ///< a `.part` of an interrupted writer exists
  in_use,        ///< another writer writes a file of the same name
  not_a_file,    ///< the name belongs to something that is neither a regular file nor a FIFO
  no_reader,     ///< no program reads the FIFO
  no_free_number,  ///< every number that a name can have is in use
  no_answer,       ///< a write or close took too long and was abandoned
};

/// Why a write or a close failed. Trivially copyable.
struct SinkFault {
  SinkReason reason{};
  Fault fault{};         ///< used with not_encodable
  int error_number = 0;  ///< used with system
};
bool operator==(const SinkFault&, const SinkFault&) noexcept;
bool operator<(const SinkFault&, const SinkFault&) noexcept;
/// One line for users.
std::string describe(const SinkFault&);

/// What was written so far. Trivially copyable.
struct SinkStatistics {
  std::uint64_t params = 0, constants = 0;  ///< records written, including repeated constants
  std::uint64_t errors = 0;
};

/// The time for which a record is valid.
struct RecordTime {
  // NOLINTNEXTLINE(google-explicit-constructor): a time without a code is complete
  RecordTime(std::int64_t since_1970 = 0, std::optional<base::TimeCodeWithRate> code = {}) noexcept
      : nanoseconds(since_1970), time_code(code) {}

  std::int64_t nanoseconds;  ///< since 1970 UTC; 0: now
  std::optional<base::TimeCodeWithRate> time_code;
};

/// The result of a write or a close.
using WriteResult = tl::expected<void, SinkFault>;
/// A fault to return.
inline tl::unexpected<SinkFault> refused(SinkReason reason) noexcept { return tl::unexpected(SinkFault{reason}); }
/// A fault to return for an errno.
inline tl::unexpected<SinkFault> refused_by_system(int error_number) noexcept {
  return tl::unexpected(SinkFault{SinkReason::system, {}, error_number});
}

/// Writes records to one endpoint. A failed write does not affect the records before and after it. One thread at a
/// time, except for statistics(), name() and notice().
///
/// The caller decides whether constants are new (see camera::Converter): a sink writes all that it gets. Datagram sinks
/// repeat constants by themselves, for receivers that join late.
class Sink {
 public:
  virtual ~Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  /// Creates the file, or attaches to or creates the segment, so that errors are known before the first write. May
  /// block. Throws TransportError with the reason; a later write or call tries again. Does nothing if it is done
  /// already.
  void prepare();
  /// Writes one set of parameters. A datagram sink first sends the constants of the same id if their period has passed.
  [[nodiscard]] WriteResult write(const wire::CameraParams&, const RecordTime& time = {});
  [[nodiscard]] WriteResult write(const wire::CameraConstants&);
  /// Closes the sink: a file gets its final name. Closing again does nothing. The destructor closes as well, but cannot
  /// report errors.
  [[nodiscard]] WriteResult close();

  /// A consistent snapshot. Any thread.
  SinkStatistics statistics() const noexcept { return published_.load(); }
  /// The endpoint for users: "udp to 192.0.2.7:7000", "shm slot 7", "file take.trk". Any thread. A file that is named
  /// by the time of its first field has its name from that field on.
  virtual std::string name() const = 0;
  /// Information for users when nothing is wrong: recordings that were recovered. Any thread.
  virtual std::string notice() const { return {}; }

 protected:
  Sink() = default;
  /// Counts repeated constants.
  void count_constants() noexcept { ++counts_.constants; }
  /// Counts parameters that were written although put() returns a fault.
  void count_params() noexcept { ++counts_.params; }
  /// The time of the parameters that are passed to put().
  const RecordTime& time() const noexcept { return time_; }

 private:
  virtual void get_ready() {}
  virtual WriteResult put(const wire::CameraParams&) = 0;
  virtual WriteResult put(const wire::CameraConstants&) = 0;
  virtual WriteResult finish() = 0;
  WriteResult counted(const WriteResult&, std::uint64_t& good) noexcept;

  bool closed_ = false;
  RecordTime time_;
  SinkStatistics counts_;
  base::Snapshot<SinkStatistics> published_;
};

}  // namespace trk_bridge::transport
