// The C interface, call by call, beside what it cannot be faster than.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "trk_mem.h"
#include "trk_net.h"

namespace {

constexpr int slot = 61;

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
BENCHMARK(two_copies_of_200_bytes);

void memory_write_and_read(benchmark::State& state) {
  trkHandle writer = nullptr, reader = nullptr;
  require(trkMemOpen(slot, &writer));
  require(trkMemOpen(slot, &reader));
  trkCameraParams sent = params(), got{};
  for (auto _ : state) {
    ++sent.counter;
    require(trkMemWriteParams(writer, &sent));
    require(trkMemReadParams(reader, &got));
  }
  trkMemCloseAll();
}
BENCHMARK(memory_write_and_read);

void memory_nothing_new(benchmark::State& state) {
  trkHandle reader = nullptr, writer = nullptr;
  require(trkMemOpen(slot, &writer));
  require(trkMemOpen(slot, &reader));
  trkCameraParams got{};
  for (auto _ : state) benchmark::DoNotOptimize(trkMemReadParams(reader, &got));
  trkMemCloseAll();
}
BENCHMARK(memory_nothing_new);

/// A port of the loopback that nobody has.
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

void two_bare_system_calls(benchmark::State& state) {
  const int out = ::socket(AF_INET, SOCK_DGRAM, 0), in = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(free_port());
  if (::bind(in, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) std::abort();
  if (::connect(out, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) std::abort();
  char bytes[208] = {}, received[4096];
  for (auto _ : state) {
    if (::send(out, bytes, sizeof bytes, 0) != sizeof bytes) std::abort();
    if (::recv(in, received, sizeof received, 0) != sizeof bytes) std::abort();
  }
  ::close(out);
  ::close(in);
}
BENCHMARK(two_bare_system_calls);

/// What trkNet asks of the system beside that: no receiver that went away fails the next datagram, so that the sender
/// is not connected; either family; and with a datagram its sender and the kernel's time.
void two_bare_system_calls_with_sender_and_time(benchmark::State& state) {
  const int out = ::socket(AF_INET, SOCK_DGRAM, 0), in = ::socket(AF_INET6, SOCK_DGRAM, 0);
  const int off = 0, on = 1;
  ::setsockopt(in, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
  ::setsockopt(in, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(free_port());
  sockaddr_in6 address{};
  address.sin6_family = AF_INET6;
  address.sin6_port = to.sin_port;
  if (::bind(in, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) std::abort();
  char bytes[208] = {}, received[4096], control[CMSG_SPACE(sizeof(timespec))];
  sockaddr_storage sender;
  iovec part{received, sizeof received};
  for (auto _ : state) {
    mmsghdr header{};
    header.msg_hdr = {&sender, sizeof sender, &part, 1, control, sizeof control, 0};
    if (::sendto(out, bytes, sizeof bytes, 0, reinterpret_cast<sockaddr*>(&to), sizeof to) != sizeof bytes) {
      std::abort();
    }
    if (::recvmmsg(in, &header, 1, MSG_DONTWAIT, nullptr) != 1) std::abort();
  }
  ::close(out);
  ::close(in);
}
BENCHMARK(two_bare_system_calls_with_sender_and_time);

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
void binary_datagram_write_and_read(benchmark::State& state) { network(state, 1); }
BENCHMARK(binary_datagram_write_and_read);
void ascii_datagram_write_and_read(benchmark::State& state) { network(state, 0); }
BENCHMARK(ascii_datagram_write_and_read);

}  // namespace

BENCHMARK_MAIN();
