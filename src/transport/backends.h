// What the factory chooses from. Each opener throws TransportError.
#pragma once

#include <memory>

#include "trk_bridge/transport/endpoint.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

std::unique_ptr<Source> open_udp_source(const UdpEndpoint&);
std::unique_ptr<Source> open_shm_source(const ShmEndpoint&);
std::unique_ptr<Source> open_file_source(const FileEndpoint&, double field_rate);
std::unique_ptr<Source> open_memory_source(const MemoryEndpoint&);

std::unique_ptr<Sink> open_udp_sink(const UdpEndpoint&);
std::unique_ptr<Sink> open_shm_sink(const ShmEndpoint&);
std::unique_ptr<Sink> open_file_sink(const FileEndpoint&);
std::unique_ptr<Sink> open_memory_sink(const MemoryEndpoint&);

}  // namespace trk_bridge::transport
