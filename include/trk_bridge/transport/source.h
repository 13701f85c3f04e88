// Where records come from: one interface over datagrams, shared memory and files.
#pragma once

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "trk_bridge/transport/sample.h"

namespace trk_bridge::transport {

/// An endpoint that cannot be opened or was written wrongly; the text names the endpoint and the reason.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What one call of Source::receive met.
enum class Event : std::uint8_t {
  sample,     ///< `Reception::sample` is good
  malformed,  ///< one record was not sound: `fault`, `sample.sender` and `sample.arrival` are its; go on
  idle,       ///< nothing came within the time given
  stopped,    ///< stop() was called; every later call says so at once
  ended,      ///< the last record of a file was given
  failed,     ///< the source cannot go on: statistics().error says why
};

/// Filled by receive(); reuse one, so that nothing allocates.
struct Reception {
  Sample sample;
  Fault fault;
  /// False: when the kernel was last asked, no other datagram was there. Only another receive() asks it again.
  bool more = true;
};

/// How far a source has come. `receiving` is only ever reached by a valid record.
enum class SourceState : std::uint8_t {
  waiting,        ///< for a segment, or bound and nothing received
  nothing_valid,  ///< something comes, but none of it is trk
  only_refused,   ///< something comes, but only from senders that are not allowed
  receiving,      ///< at least one valid record has come
  ended,
  failed,
};

/// What has come so far.
struct SourceStatistics {
  SourceState state = SourceState::waiting;
  std::uint64_t records = 0;  ///< valid ones handed out
  std::uint64_t malformed = 0;
  std::uint64_t refused = 0;              ///< datagrams of senders that are not allowed
  std::uint64_t kernel_drops = 0;         ///< datagrams the kernel threw away because nobody read in time
  std::uint64_t receive_buffer = 0;       ///< bytes the kernel granted for datagrams not read yet; 0: not a socket
  std::uint64_t wanted_buffer = 0;        ///< bytes that were asked for
  std::uint64_t overwritten = 0;          ///< shared memory: sets written and replaced before they were seen
  std::uint64_t unknown_format_bits = 0;  ///< records with bits above wire::known_format_bits
  std::uint64_t reattached = 0;           ///< shared memory: segments attached to after the first
  std::uint64_t doubtful = 0;             ///< records handed out that have a Sample::doubt
  const char* last_doubt = "";            ///< of the last of them
  Sender last_refused;
  std::string error;  ///< when failed: one line for a person
  /// When waiting, and whenever nothing can come: "slot 7: no segment", "udp port 7000: bound, nothing received yet",
  /// "udp port 7000: interface eth0 is down".
  std::string waiting_for;
};

/// One place that records come from, opened by endpoints::open_source().
class Source {
 public:
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// The next record, waiting at most `wait` for it (0: only what is there already; negative: without end). Blocks in
  /// the kernel. One thread at a time. Does not allocate or log while records come.
  [[nodiscard]] virtual Event receive(Reception& into, std::chrono::nanoseconds wait) = 0;

  /// Wakes receive() at once and for good. Any thread, any number of times, safe in a signal handler.
  virtual void stop() noexcept = 0;

  /// A consistent snapshot. Any thread.
  virtual SourceStatistics statistics() const = 0;

  /// The endpoint as a person reads it: "udp port 7000 on every interface", "shm slot 7", "file take.trk".
  virtual std::string name() const = 0;

 protected:
  Source() = default;
};

}  // namespace trk_bridge::transport
