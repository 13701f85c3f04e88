// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The C interface, call by call, compared with its lower limits.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "free_slot.h"
#include "trk_mem.h"
#include "trk_net.h"

namespace {

using namespace trk_bridge;

trkCameraParams params() {
  trkCameraParams p{};
  p.format = trkEuler;
  p.t.e = {1.5, -2, 1.75, 30.123, -5.25, 0.5};
  p.fov = 7.5;
  p.k1 = -0.001;
  p.focdist = 4.5;
  return p;
}

void require(trkError error) {
  if (error != trkOK) std::abort();
}

void two_copies_of_200_bytes(benchmark::State& state) {
  trkCameraParams a = params(), b{}, c{};
  for (auto _ : state) {
    std::memcpy(&b, &a, sizeof b);
    benchmark::DoNotOptimize(b);
    std::memcpy(&c, &b, sizeof c);
    benchmark::DoNotOptimize(c);
  }
}

void memory_write_and_read(benchmark::State& state, bool has_own_reader) {
  const test::FreeSlot slot;
  trkHandle writer = nullptr;
  require(trkMemOpen(slot.number(), &writer));
  trkHandle reader = writer;
  if (has_own_reader) require(trkMemOpen(slot.number(), &reader));
  trkCameraParams sent = params(), got{};
  for (auto _ : state) {
    ++sent.counter;
    require(trkMemWriteParams(writer, &sent));
    require(trkMemReadParams(reader, &got));
  }
  trkMemCloseAll();
}
void memory_two_handles(benchmark::State& state) { memory_write_and_read(state, true); }
// Each handle has its own addresses. Some processors need longer to read what was written at another address.
void memory_one_handle(benchmark::State& state) { memory_write_and_read(state, false); }
BENCHMARK(memory_two_handles)->Name("BM_c_api_memory/ours");
BENCHMARK(memory_one_handle)->Name("BM_c_api_memory_one_handle");
BENCHMARK(two_copies_of_200_bytes)->Name("BM_c_api_memory/peer");

void memory_nothing_new(benchmark::State& state) {
  const test::FreeSlot slot;
  trkHandle reader = nullptr, writer = nullptr;
  require(trkMemOpen(slot.number(), &writer));
  require(trkMemOpen(slot.number(), &reader));
  trkCameraParams got{};
  for (auto _ : state) benchmark::DoNotOptimize(trkMemReadParams(reader, &got));
  trkMemCloseAll();
}
BENCHMARK(memory_nothing_new)->Name("BM_c_api_memory_nothing_new");

/// A free port of the loopback interface.
std::uint16_t free_port() {
  const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) std::abort();
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(fd);
  return ntohs(address.sin_port);
}

/// Sends a datagram to a port of this machine and receives it, with the two system calls that cost least.
class BareSockets {
 public:
  BareSockets() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(free_port());
    if (::bind(in_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) std::abort();
    if (::connect(out_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) std::abort();
  }
  ~BareSockets() {
    ::close(out_);
    ::close(in_);
  }
  BareSockets(const BareSockets&) = delete;
  BareSockets& operator=(const BareSockets&) = delete;

  void pass(const char* bytes, std::size_t size, char (&received)[4096]) {
    if (::send(out_, bytes, size, 0) != static_cast<ssize_t>(size)) std::abort();
    if (::recv(in_, received, sizeof received, 0) != static_cast<ssize_t>(size)) std::abort();
  }

 private:
  const int out_ = ::socket(AF_INET, SOCK_DGRAM, 0), in_ = ::socket(AF_INET, SOCK_DGRAM, 0);
};

void two_cheapest_system_calls(benchmark::State& state) {
  BareSockets sockets;
  char bytes[208] = {}, received[4096];
  for (auto _ : state) sockets.pass(bytes, sizeof bytes, received);
}

/// ASCII as existing programs print and read it, with the same two system calls.
void bare_ascii(benchmark::State& state) {
  BareSockets sockets;
  char text[4096] = "DMC01\0PA", received[4096];
  trkCameraParams p = params(), got{};
  for (auto _ : state) {
    ++p.counter;
    const auto& e = p.t.e;
    const int size =
        std::sprintf(text + 8, "%X %g %g %g %g %g %g %g %e %e %e %e %g %g %lu", p.format, e.x, e.y, e.z, e.pan, e.tilt,
                     e.roll, p.fov, p.centerX, p.centerY, p.k1, p.k2, p.focdist, p.aperture, p.counter);
    sockets.pass(text, static_cast<std::size_t>(8 + size + 1), received);
    auto& r = got.t.e;
    const int read = std::sscanf(received + 8, "%x %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lu",
                                 &got.format, &r.x, &r.y, &r.z, &r.pan, &r.tilt, &r.roll, &got.fov, &got.centerX,
                                 &got.centerY, &got.k1, &got.k2, &got.focdist, &got.aperture, &got.counter);
    if (read != 15) std::abort();
  }
}

/// The two system calls of trkNet, and nothing else. They cost more than those of BareSockets: the sender is not
/// connected, so that it follows a change of the routes and of its own address, and a receiver that went away does not
/// make the next datagram fail; the receiver takes both address families, returns the sender of each datagram, and
/// looks whether there are more.
void the_same_two_system_calls(benchmark::State& state) {
  constexpr std::size_t batch = 32;
  const int out = ::socket(AF_INET, SOCK_DGRAM, 0), in = ::socket(AF_INET6, SOCK_DGRAM, 0);
  const int off = 0;
  ::setsockopt(in, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(free_port());
  sockaddr_in6 address{};
  address.sin6_family = AF_INET6;
  address.sin6_port = to.sin_port;
  if (::bind(in, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) std::abort();
  static char received[batch][4096];
  char bytes[208] = {};
  sockaddr_storage senders[batch];
  iovec parts[batch];
  mmsghdr headers[batch]{};
  for (std::size_t i = 0; i < batch; ++i) {
    parts[i] = {received[i], sizeof received[i]};
    headers[i].msg_hdr = {&senders[i], sizeof senders[i], &parts[i], 1, nullptr, 0, 0};
  }
  for (auto _ : state) {
    headers[0].msg_hdr.msg_namelen = sizeof senders[0];
    if (::sendto(out, bytes, sizeof bytes, 0, reinterpret_cast<sockaddr*>(&to), sizeof to) != sizeof bytes) {
      std::abort();
    }
    if (::recvmmsg(in, headers, batch, MSG_DONTWAIT, nullptr) != 1) std::abort();
  }
  ::close(out);
  ::close(in);
}

void network(benchmark::State& state, int binary) {
  const int port = free_port();
  trkHandle writer = nullptr, reader = nullptr;
  require(trkNetOpenRead(port, &reader));
  require(trkNetOpenWrite("127.0.0.1", port, binary, &writer));
  trkCameraParams sent = params(), got{};
  for (auto _ : state) {
    ++sent.counter;
    require(trkNetWriteParams(writer, &sent));
    require(trkNetReadParams(reader, &got));
  }
  require(trkNetClose(writer));
  require(trkNetClose(reader));
}
void binary(benchmark::State& state) { network(state, 1); }
void ascii(benchmark::State& state) { network(state, 0); }

BENCHMARK(binary)->Name("BM_c_api_binary_datagram/ours");
BENCHMARK(the_same_two_system_calls)->Name("BM_c_api_binary_datagram/peer");
BENCHMARK(two_cheapest_system_calls)->Name("BM_c_api_two_cheapest_system_calls");
BENCHMARK(ascii)->Name("BM_c_api_ascii_datagram/ours");
BENCHMARK(bare_ascii)->Name("BM_c_api_ascii_datagram/peer");

}  // namespace

BENCHMARK_MAIN();
