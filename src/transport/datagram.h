// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Protocols over UDP: the interface of a protocol, and the options that all their URLs have.
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

/// Decodes the datagrams of one port to samples. May store data per sender. Not synchronised; does not allocate while
/// it receives datagrams.
class Decoder {
 public:
  virtual ~Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  enum class Next : std::uint8_t {
    sample,  ///< `into` has the next sample
    fault,   ///< one record was malformed; there may be more
    none,    ///< the datagram has no more samples
  };

  /// Sets the datagram whose samples next() returns. The bytes must stay valid until the next call of begin().
  virtual void begin(std::string_view datagram, const Sender&) noexcept = 0;
  /// Fills all fields of a sample except arrival and sender, which the socket provides.
  [[nodiscard]] virtual Next next(Sample& into, Fault& fault) noexcept = 0;

 protected:
  Decoder() = default;
};

/// Encodes records to datagrams. Not synchronised; does not allocate while records are written.
class Encoder {
 public:
  virtual ~Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// The time for which the parameters of the next begin() are valid: `nanoseconds` since 1970 UTC. For protocols that
  /// have a time.
  virtual void use_time(std::int64_t /*nanoseconds*/, const std::optional<base::TimeCodeWithRate>& /*code*/) noexcept {}
  /// Sets the record whose datagrams next() returns.
  [[nodiscard]] virtual tl::expected<void, Fault> begin(const wire::CameraParams&) noexcept = 0;
  [[nodiscard]] virtual tl::expected<void, Fault> begin(const wire::CameraConstants&) noexcept = 0;
  /// The next datagram, which is valid until the following call; none after the last.
  virtual std::optional<std::string_view> next() noexcept = 0;

 protected:
  Encoder() = default;
};

/// Throws TransportError.
std::unique_ptr<Source> open_datagram_source(const ReceiveSettings&, std::unique_ptr<Decoder>);
/// The same for a protocol that uses several groups: one source that listens to all of them.
std::unique_ptr<Source> open_datagram_source(const std::vector<ReceiveSettings>&, std::unique_ptr<Decoder>);

/// Where to send: one address, a broadcast address or a multicast group.
struct SendSettings {
  std::string host;        ///< IPv6 without brackets; a name is looked up when the sink is opened, IPv4 before IPv6
  std::uint16_t port = 0;  ///< 1 to 65535
  /// An address of this machine or the name of an interface, for groups; writes fail while it does not exist. Empty:
  /// the system decides.
  std::string interface;
  std::optional<int> ttl;  ///< 0..255 (unicast and broadcast 1..255): a datagram passes at most ttl - 1 routers
  /// Seconds, up to 86400, after which constants are sent again with the next parameters of their id; 0: never.
  double constants_period = 1.0;
};

/// The sink sends in the thread that writes, and never blocks. Throws TransportError.
std::unique_ptr<Sink> open_datagram_sink(const SendSettings&, std::unique_ptr<Encoder>);

extern const std::array<Option<ReceiveSettings>, 3> receive_options;
extern const std::array<Option<SendSettings>, 2> send_options;
/// For protocols with constants that are repeated.
extern const std::array<Option<SendSettings>, 1> repeat_options;

/// A usual destination of the senders of a protocol.
struct UsualPlace {
  std::uint16_t port = 0;
  std::string group;         ///< a multicast group; empty: the addresses of the receiving machine
  std::string_view senders;  ///< which senders have this default, for users
};

/// What a protocol provides for the detection of senders.
struct Detection {
  /// A way to read the protocol: the necessary options in the URL of a source, and the decoder with these options.
  struct Reading {
    std::string options;  ///< "checksum=lenient"; empty: none
    std::unique_ptr<Decoder> decoder;
  };
  /// "Free-D", for users.
  std::string_view protocol;
  /// Whether a datagram looks like this protocol, valid or malformed.
  bool (*claims)(std::string_view datagram);
  /// The strictest way first.
  std::vector<Reading> (*readings)();
  std::vector<UsualPlace> (*places)();
};

/// Reads host and port from the URL. The port is required if the protocol has no standard one.
tl::expected<void, std::string> set_place(const Url& url, ReceiveSettings& settings,
                                          std::optional<std::uint16_t> standard_port = {});
tl::expected<void, std::string> set_place(const Url& url, SendSettings& settings,
                                          std::optional<std::uint16_t> standard_port = {});

/// Host and port; equal for two URLs with the same ones.
std::string place_of(const ReceiveSettings& settings);

}  // namespace trk_bridge::transport
