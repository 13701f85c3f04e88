// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Endpoints: parsed URLs of sources and sinks, ready to be opened.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

/// A parsed URL to read from. It can be opened any number of times.
struct SourceEndpoint {
  std::string url;            ///< as given by the user
  std::string place;          ///< equal for two endpoints that read the same port, slot or file
  bool over_network = false;  ///< its records arrive with the jitter of a network
  bool can_wait = false;      ///< nothing is lost if records are read late: a take that is read as fast as possible
  /// `field_rate` (Hz) is used for takes whose URL has no `rate`. Throws TransportError: a port in use, an unknown
  /// host, a file with an error in line N (`take.trk:57: field 9 is not a number`), … A shared memory slot, an address
  /// of this machine or an interface that does not exist yet is not an error.
  std::function<std::unique_ptr<Source>(double field_rate)> open;
};

/// At time t, the camera of time t - delay is sent; each part has its own delay. ns, 0 to `most`.
struct Delay {
  std::int64_t position = 0, rotation = 0, lens = 0;

  static constexpr std::int64_t most = 1'000'000'000;
};
constexpr bool operator==(const Delay& a, const Delay& b) noexcept {
  return a.position == b.position && a.rotation == b.rotation && a.lens == b.lens;
}
constexpr bool operator!=(const Delay& a, const Delay& b) noexcept { return !(a == b); }
/// The largest allowed extrapolation of a camera beyond its newest sample, ns.
inline constexpr std::int64_t most_lead = 40'000'000;

/// Format, id and time of the records of one sink. The node or tool has defaults for what is not given.
struct SinkForm {
  /// `format=WORDS` or `preset=NAME`: a FormatBit mask that passes wire::is_writable.
  std::optional<std::uint32_t> format;
  bool sends_id = true;              ///< false with a preset whose receiver does not accept an id: 0 is sent
  std::optional<std::uint32_t> id;   ///< `id=N`: sent instead of the id of the record
  std::optional<Delay> delay;        ///< `delay=S` or `delay=POSITION,ROTATION,LENS`
  std::optional<std::int64_t> lead;  ///< `lead=S`: allowed extrapolation, ns, 0 to most_lead

  /// Whether the camera is sent for another time than that of its newest sample.
  bool is_timed() const noexcept { return delay.value_or(Delay{}) != Delay{} || lead.value_or(0) != 0; }
};
/// `given`, with missing values taken from `defaults`.
SinkForm with_defaults(const SinkForm& given, const SinkForm& defaults) noexcept;

/// What a write to a sink may wait for.
enum class Blocking : std::uint8_t {
  never,      ///< datagrams
  attaching,  ///< shared memory: newer sets replace older ones
  storage,    ///< files: every set must be written
};

/// A parsed URL to write to. It can be opened any number of times.
struct SinkEndpoint {
  std::string url;  ///< as given by the user
  SinkForm form;
  Blocking blocking = Blocking::never;
  /// Does not block, except to look up the name of a host: Sink::prepare does everything else that can block. Throws
  /// TransportError; an interface or a route that does not exist yet is not an error.
  std::function<std::unique_ptr<Sink>()> open;
};

}  // namespace trk_bridge::transport
