// Protocols over UDP: what a protocol adds to sockets, and what its URLs have in common with others.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "receive_socket.h"
#include "scheme.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::transport {

/// Datagrams of one port to samples. It may remember what it needs of each sender. Not synchronised; does not allocate
/// while datagrams come.
class Decoder {
 public:
  virtual ~Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  enum class Next : std::uint8_t {
    sample,  ///< `into` has the next one
    fault,   ///< one record was not sound; there may be more
    none,    ///< the datagram has no more
  };

  /// The datagram whose samples next() gives from now on. The bytes stay until the next call of begin().
  virtual void begin(std::string_view datagram, const Sender&) noexcept = 0;
  /// Fills all of a sample but arrival and sender, which are the socket's to know.
  [[nodiscard]] virtual Next next(Sample& into, Fault& fault) noexcept = 0;

 protected:
  Decoder() = default;
};

/// Records to datagrams. Not synchronised; does not allocate while records come.
class Encoder {
 public:
  virtual ~Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// When the parameters of the next begin() are true: `nanoseconds` since 1970 UTC. For protocols that have a time.
  virtual void use_time(std::int64_t /*nanoseconds*/, const std::optional<base::CountedTimeCode>& /*code*/) noexcept {}
  /// The record whose datagrams next() gives from now on.
  [[nodiscard]] virtual tl::expected<void, Fault> begin(const wire::CameraParams&) noexcept = 0;
  [[nodiscard]] virtual tl::expected<void, Fault> begin(const wire::CameraConstants&) noexcept = 0;
  /// The next datagram, which holds until the call after; none when all have been given.
  virtual std::optional<std::string_view> next() noexcept = 0;

 protected:
  Encoder() = default;
};

/// Throws TransportError.
std::unique_ptr<Source> open_datagram_source(const ReceiveSettings&, std::unique_ptr<Decoder>);
/// The same where a protocol comes in several groups: one source that listens to all of them.
std::unique_ptr<Source> open_datagram_source(const std::vector<ReceiveSettings>&, std::unique_ptr<Decoder>);

/// Where to send to: one address, a broadcast address or a multicast group.
struct SendSettings {
  std::string host;        ///< IPv6 without its brackets; a name is looked up at opening, IPv4 before IPv6
  std::uint16_t port = 0;  ///< 1 to 65535
  /// An address of this machine or an interface's name, for groups; writes fail while it is not there. Empty: the
  /// system's choice.
  std::string interface;
  std::optional<int> ttl;  ///< 0..255 (unicast and broadcast 1..255): it passes at most ttl - 1 routers
  /// Seconds to 86400 after which constants are sent again with the next parameters of their id; 0: never.
  double constants_period = 1.0;
};

/// Sends from the thread that writes, and never blocks. Throws TransportError.
std::unique_ptr<Sink> open_datagram_sink(const SendSettings&, std::unique_ptr<Encoder>);

extern const std::array<Option<ReceiveSettings>, 3> receive_options;
extern const std::array<Option<SendSettings>, 2> send_options;
/// Where a protocol has constants to repeat.
extern const std::array<Option<SendSettings>, 1> repeat_options;

/// Where senders of a protocol are often set to send.
struct UsualPlace {
  std::uint16_t port = 0;
  std::string group;         ///< a multicast group; empty: the addresses of the receiving machine
  std::string_view senders;  ///< whose default it is, for a person
};

/// What a protocol offers to a program that looks for senders.
struct Detection {
  /// A way to read the protocol: the options that a source's URL needs for it, and the decoder that they give.
  struct Reading {
    std::string options;  ///< "checksum=lenient"; empty: none
    std::unique_ptr<Decoder> decoder;
  };
  /// "Free-D", for a person.
  std::string_view protocol;
  /// Whether a datagram claims to be of this protocol, sound or not.
  bool (*claims)(std::string_view datagram);
  /// The strictest way first.
  std::vector<Reading> (*readings)();
  std::vector<UsualPlace> (*places)();
};

/// Host and port of the URL. The port must be given where the protocol has no standard one.
tl::expected<void, std::string> set_place(const Url& url, ReceiveSettings& settings,
                                          std::optional<std::uint16_t> standard_port = {});
tl::expected<void, std::string> set_place(const Url& url, SendSettings& settings,
                                          std::optional<std::uint16_t> standard_port = {});

/// Host and port; equal for two URLs that name the same.
std::string place_of(const ReceiveSettings& settings);

}  // namespace trk_bridge::transport
