// A place that records come from or go to, named by a URL: read once, kept parsed, ready to be opened.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

/// A URL to read from. Copies may be opened again and again.
struct SourceEndpoint {
  std::string url;            ///< as it was given
  std::string place;          ///< equal for two endpoints that read the same port, slot or file
  bool over_network = false;  ///< its records arrive with a network's jitter
  bool can_wait = false;      ///< nothing is lost where its records are taken late: a take without a pace of its own
  /// `field_rate` (Hz) counts for takes whose URL has no `rate`. Throws TransportError: a port in use, a host that is
  /// not known, a file with an error in line N (`take.trk:57: field 9 is not a number`), … A shared memory slot, an
  /// address of this machine or an interface that is not there yet is no error.
  std::function<std::unique_ptr<Source>(double field_rate)> open;
};

/// What is sent at time t is the camera at t - delay, each part by itself. ns, 0 to `most`.
struct Delay {
  std::int64_t position = 0, rotation = 0, lens = 0;

  static constexpr std::int64_t most = 1'000'000'000;
};
constexpr bool operator==(const Delay& a, const Delay& b) noexcept {
  return a.position == b.position && a.rotation == b.rotation && a.lens == b.lens;
}
constexpr bool operator!=(const Delay& a, const Delay& b) noexcept { return !(a == b); }
/// How far, in ns, a camera may be extrapolated beyond its newest sample at most.
inline constexpr std::int64_t most_lead = 40'000'000;

/// How one sink's records are expressed, and of when they are. What is not given is up to the program: a node's or a
/// tool's own defaults.
struct SinkForm {
  /// `format=WORDS` or `preset=NAME`: FormatBit mask that passes wire::is_writable.
  std::optional<std::uint32_t> format;
  bool sends_id = true;              ///< false with a preset whose receiver takes no id: 0 is sent
  std::optional<std::uint32_t> id;   ///< `id=N`: sent in place of the record's own
  std::optional<Delay> delay;        ///< `delay=S` or `delay=POSITION,ROTATION,LENS`
  std::optional<std::int64_t> lead;  ///< `lead=S`: how far it may be extrapolated, ns, 0 to most_lead

  /// Whether the camera is sent of another time than that of its newest sample.
  bool is_timed() const noexcept { return delay.value_or(Delay{}) != Delay{} || lead.value_or(0) != 0; }
};
/// `given`, with what it does not say taken from `defaults`.
SinkForm with_defaults(const SinkForm& given, const SinkForm& defaults) noexcept;

/// What a write to a sink may wait for.
enum class Blocking : std::uint8_t {
  never,      ///< datagrams
  attaching,  ///< shared memory: newer sets make older ones useless
  storage,    ///< files: every set counts
};

/// A URL to write to. Copies may be opened again and again.
struct SinkEndpoint {
  std::string url;  ///< as it was given
  SinkForm form;
  Blocking blocking = Blocking::never;
  /// Does not block, apart from looking up a host's name: what else can block is done by Sink::prepare. Throws
  /// TransportError; an interface or a route that is not there yet is no error.
  std::function<std::unique_ptr<Sink>()> open;
};

}  // namespace trk_bridge::transport
