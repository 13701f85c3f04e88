// What a protocol does with the datagrams of its senders.
#pragma once

#include <cstdint>
#include <string_view>

#include "trk_bridge/transport/fault.h"
#include "trk_bridge/transport/sample.h"

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

}  // namespace trk_bridge::transport
