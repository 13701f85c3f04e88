#include <type_traits>

#include "backends.h"

namespace trk_bridge::transport {

namespace {

Endpoint parsed(std::string_view url, Direction direction) {
  auto endpoint = parse_endpoint(url, direction);
  if (!endpoint) throw TransportError(endpoint.error());
  return *std::move(endpoint);
}

}  // namespace

std::unique_ptr<Source> open_source(const Endpoint& endpoint, double field_rate) {
  return std::visit(
      [field_rate](const auto& e) {
        using E = std::decay_t<decltype(e)>;
        if constexpr (std::is_same_v<E, UdpEndpoint>) return open_udp_source(e);
        if constexpr (std::is_same_v<E, ShmEndpoint>) return open_shm_source(e);
        if constexpr (std::is_same_v<E, FileEndpoint>) return open_file_source(e, field_rate);
        if constexpr (std::is_same_v<E, MemoryEndpoint>) return open_memory_source(e);
      },
      endpoint);
}

std::unique_ptr<Source> open_source(std::string_view url, double field_rate) {
  return open_source(parsed(url, Direction::read), field_rate);
}

std::unique_ptr<Sink> open_sink(const Endpoint& endpoint) {
  return std::visit(
      [](const auto& e) {
        using E = std::decay_t<decltype(e)>;
        if constexpr (std::is_same_v<E, UdpEndpoint>) return open_udp_sink(e);
        if constexpr (std::is_same_v<E, ShmEndpoint>) return open_shm_sink(e);
        if constexpr (std::is_same_v<E, FileEndpoint>) return open_file_sink(e);
        if constexpr (std::is_same_v<E, MemoryEndpoint>) return open_memory_sink(e);
      },
      endpoint);
}

std::unique_ptr<Sink> open_sink(std::string_view url) { return open_sink(parsed(url, Direction::write)); }

}  // namespace trk_bridge::transport
