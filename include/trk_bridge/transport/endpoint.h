// One URL names every place that trk bytes come from or go to.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::transport {

/// Which way the bytes go: options differ.
enum class Direction : std::uint8_t { read, write };

/// `udp://[host][:port][?options]`. The port must be given: the field has no standard one.
struct UdpEndpoint {
  std::string host;  ///< empty: every interface (read only); IPv6 without its brackets
  std::uint16_t port = 0;
  std::string interface;  ///< `interface=ADDR`: multicast goes through it; empty: the system's choice
  wire::LayoutChoice layout;  ///< `layout=…`
  // read
  std::vector<std::string> allow;  ///< `allow=ADDR[,ADDR…]`: senders accepted; empty: all
  std::optional<int> buffer;  ///< `buffer=BYTES`: the kernel's receive buffer
  // write
  bool binary = false;  ///< `binary=1`
  std::optional<int> ttl;  ///< `ttl=N`, 0..255
  double constants_period = 1.0;  ///< `constants_period=SECONDS`; 0: constants are sent only when they change
};

/// `shm:SLOT[?options]`, slots 0..61.
struct ShmEndpoint {
  int slot = 0;
  wire::LayoutChoice layout;  ///< `layout=…`, when creating; default the document's LP64
  int mode = 0666;  ///< `mode=0666`, octal, when creating
  bool recreate = false;  ///< `recreate=1`: the document's trkMemRecreate
};

/// Time of the samples of a file.
enum class FileTime : std::uint8_t {
  timecode,  ///< the time code of the first field on `date`, plus the fields since
  now,  ///< the moment a sample is handed out
};

/// `file:PATH[?options]`.
struct FileEndpoint {
  std::string path;
  // read
  std::optional<double> rate;  ///< `rate=HZ`: video fields a second; default 50
  double speed = 1.0;  ///< `speed=X`; 0: as fast as possible
  bool loop = false;  ///< `loop=1`
  FileTime time = FileTime::timecode;  ///< `time=timecode|now`
  std::optional<std::int64_t> date;  ///< `date=YYYY-MM-DD` in UTC, as seconds since 1970; default the day of opening
  // write
  std::string timecode = "00:00:00:00:1";  ///< `timecode=HH:MM:SS:FF:D`
  bool overwrite = false;  ///< `overwrite=1`
};

/// `memory:NAME`: a queue inside this process, for tests. Sinks and sources of one name share it.
struct MemoryEndpoint {
  std::string name;
};

using Endpoint = std::variant<UdpEndpoint, ShmEndpoint, FileEndpoint, MemoryEndpoint>;

/// Reads a URL. The error names the part, its value and what is allowed; an unknown option's lists the known ones for
/// that scheme and direction. `%XX` in paths and values stands for a byte (needed for `?`, `&`, `%`).
tl::expected<Endpoint, std::string> parse_endpoint(std::string_view url, Direction);

}  // namespace trk_bridge::transport
