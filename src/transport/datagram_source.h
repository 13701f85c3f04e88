// A source made of a port and the decoder of a protocol.
#pragma once

#include <memory>

#include "decoder.h"
#include "receive_socket.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

/// Throws TransportError.
std::unique_ptr<Source> open_datagram_source(const ReceiveSettings&, std::unique_ptr<Decoder>);

}  // namespace trk_bridge::transport
