// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Sources: one interface for reading datagrams, shared memory and files.
#pragma once

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "trk_bridge/transport/sample.h"

namespace trk_bridge::transport {

/// An endpoint cannot be opened or its URL is wrong; the text names the endpoint and the reason.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The result of Source::receive.
enum class Event : std::uint8_t {
  sample,     ///< `Reception::sample` is valid
  malformed,  ///< one record was malformed: see `fault`, `sample.sender` and `sample.arrival`; continue
  idle,       ///< nothing arrived within the given time
  stopped,    ///< stop() was called; every later call returns this at once
  ended,      ///< the last record of a file was returned before
  failed,     ///< the source cannot continue: statistics().error gives the reason
};

/// Filled by receive(); reuse it to avoid allocations.
struct Reception {
  Sample sample;
  Fault fault;
  /// False: at the last system call, no other datagram was available. Only another receive() asks again.
  bool more = true;
};

/// State of a source. It becomes `receiving` only by a valid record.
enum class SourceState : std::uint8_t {
  waiting,        ///< waiting for a segment, or bound and nothing received
  nothing_valid,  ///< data arrives, but none of it is valid
  only_refused,   ///< data arrives, but only from senders that are not allowed
  receiving,      ///< at least one valid record was received
  ended,
  failed,
};

/// What was received so far.
struct SourceStatistics {
  SourceState state = SourceState::waiting;
  std::uint64_t records = 0;  ///< valid records returned
  std::uint64_t malformed = 0;
  std::uint64_t refused = 0;              ///< datagrams from senders that are not allowed
  std::uint64_t kernel_drops = 0;         ///< datagrams that the kernel dropped because they were not read in time
  std::uint64_t receive_buffer = 0;       ///< bytes that the kernel granted for datagrams not read yet; 0: not a socket
  std::uint64_t wanted_buffer = 0;        ///< bytes that were requested
  std::uint64_t overwritten = 0;          ///< shared memory: sets replaced by newer ones before they were read
  std::uint64_t unknown_format_bits = 0;  ///< records with bits above wire::known_format_bits
  std::uint64_t reattached = 0;           ///< shared memory: segments attached after the first
  std::uint64_t doubtful = 0;             ///< records returned with a Sample::doubt
  const char* last_doubt = "";            ///< the last such text
  Sender last_refused;
  std::string error;  ///< when failed: one line for users
  /// When waiting, and whenever nothing can arrive: "slot 7: no segment", "udp port 7000: bound, nothing received yet",
  /// "udp port 7000: interface eth0 is down".
  std::string waiting_for;
};

/// Reads records from one endpoint; opened by endpoints::open_source().
class Source {
 public:
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// Returns the next record; waits for it at most `wait` (0: does not wait; negative: no limit). Blocks in the kernel.
  /// One thread at a time. Does not allocate or log while it receives records.
  [[nodiscard]] virtual Event receive(Reception& into, std::chrono::nanoseconds wait) = 0;

  /// Ends receive() at once, and every later call. Any thread, any number of times, safe in a signal handler.
  virtual void stop() noexcept = 0;

  /// A consistent snapshot. Any thread.
  virtual SourceStatistics statistics() const = 0;

  /// The endpoint for users: "udp port 7000 on every interface", "shm slot 7", "file take.trk".
  virtual std::string name() const = 0;

 protected:
  Source() = default;
};

}  // namespace trk_bridge::transport
