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

/// `udp://[host]:port[?options]`. The port must be given: the field has no standard one.
///
/// Reading binds to the host, which is an address of this machine, a multicast group, which is joined, or a broadcast
/// address. Empty and `::` stand for every interface and both families, `0.0.0.0` for every interface and IPv4 alone.
/// Several readers share a group or a broadcast address and each gets every datagram; the kernel gives a datagram to
/// one address to one reader only, so that a second reader elsewhere is refused.
struct UdpEndpoint {
  std::string host;        ///< IPv6 without its brackets; a name is looked up at opening, IPv4 before IPv6
  std::uint16_t port = 0;  ///< 0, reading only: the kernel picks one, Source::name tells it
  /// `interface=ADDR`, an address of this machine or an interface's name: multicast goes through it. Empty: writing,
  /// the system's choice; reading, every interface that is up at opening and can do multicast, and the loopback.
  std::string interface;
  /// `layout=…` of binary records; what is not said is found out in reading and identified, LP64, little-endian in
  /// writing. Writing, it needs `binary=1`.
  wire::LayoutChoice layout;
  // read
  std::vector<std::string> allow;  ///< `allow=ADDR[,ADDR…]`: senders accepted; empty: all
  /// `buffer=BYTES`: the kernel's receive buffer, 1 to 1073741823. Opening fails when the kernel grants less.
  std::optional<int> buffer;
  // write
  bool binary = false;     ///< `binary=1`
  std::optional<int> ttl;  ///< `ttl=N`, 0..255 (unicast and broadcast 1..255): how many routers it may pass, less one
  double constants_period = 1.0;  ///< `constants_period=SECONDS`, to 86400; 0: constants are sent only when they change
  bool resend_equal = false;      ///< no option of URLs: constants are sent at every write, not only when they change
};

/// `shm:SLOT[?options]`, slots 0..61.
struct ShmEndpoint {
  int slot = 0;
  wire::LayoutChoice layout;  ///< `layout=…`, when creating; default the document's LP64
  int mode = 0666;            ///< `mode=0666`, octal, to 0777, when creating
  bool recreate = false;      ///< `recreate=1`: the document's trkMemRecreate
};

/// Time of the samples of a file.
enum class FileTime : std::uint8_t {
  timecode,  ///< the time code of the first field on `date`, plus the fields since
  now,       ///< the moment a sample is handed out
};

/// `file:PATH[?options]`.
struct FileEndpoint {
  std::string path;
  // read
  std::optional<double> rate;          ///< `rate=HZ`, 0.001 to 100000: video fields a second
  double speed = 1.0;                  ///< `speed=X`, 0.001 to 1000; 0: as fast as possible
  bool loop = false;                   ///< `loop=1`
  FileTime time = FileTime::timecode;  ///< `time=timecode|now`
  std::optional<std::int64_t> date;    ///< `date=YYYY-MM-DD` in UTC, as seconds since 1970; default the day of opening
  // write
  std::string timecode = "00:00:00:00:1";  ///< `timecode=HH:MM:SS:FF:D`
  bool overwrite = false;                  ///< `overwrite=1`
};

/// `memory:NAME`: a queue inside this process, for tests. Sinks and sources of one name share it.
struct MemoryEndpoint {
  std::string name;
};

/// One of them: what open_source() and open_sink() take.
using Endpoint = std::variant<UdpEndpoint, ShmEndpoint, FileEndpoint, MemoryEndpoint>;

/// Reads a URL. The error names the part, its value and what is allowed; an unknown option's lists the known ones for
/// that scheme and direction. `%XX` in paths and values stands for a byte (needed for `?`, `&`, `%`).
tl::expected<Endpoint, std::string> parse_endpoint(std::string_view url, Direction);

}  // namespace trk_bridge::transport
