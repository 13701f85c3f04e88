// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures the time from the write of a set to shared memory to its reception in another process, and the CPU time of
// waiting for it: the source compared with the bare mechanisms. Prints CSV: name, ours, peer, unit.
//
//   shm_bench [SECONDS [ROUNDS]]: each measurement takes SECONDS (2), and all are repeated ROUNDS times (3).
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "free_slot.h"
#include "shm/scheme.h"
#include "shm/segment.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge {
namespace {

std::int64_t now_ns() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

void sleep_until(std::int64_t at) noexcept {
  timespec time{};
  time.tv_sec = static_cast<time_t>(at / 1'000'000'000);
  time.tv_nsec = static_cast<long>(at % 1'000'000'000);
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

double cpu_seconds() noexcept {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Shared by the two processes: when each set was written, and a word to wait for.
struct Shared {
  static constexpr std::size_t most = 1 << 20;
  std::array<std::atomic<std::int64_t>, most> written;
  std::atomic<std::uint32_t> word;
};

Shared& shared() {
  static Shared* const memory =
      new (::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Shared;
  return *memory;
}

/// A process that calls `write(counter)` at the rate; the destructor ends it.
class Writer {
 public:
  Writer(double rate, const std::function<std::function<void(std::uint64_t)>()>& prepare) {
    if (rate == 0) return;
    child_ = ::fork();
    if (child_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const auto write = prepare();
    const auto period = static_cast<std::int64_t>(1e9 / rate);
    std::int64_t at = now_ns();
    for (std::uint64_t counter = 1; counter < Shared::most; ++counter) {
      sleep_until(at += period);
      shared().written[counter] = now_ns();
      write(counter);
    }
    ::_exit(0);
  }
  ~Writer() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

 private:
  pid_t child_ = 0;
};

/// The result of one way of reading.
struct Result {
  std::vector<double> latencies;  // us
  double cpu = 0, seconds = 0;

  double quantile(double part) {
    if (latencies.empty()) return 0;
    const auto at = latencies.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(latencies.size() - 1));
    std::nth_element(latencies.begin(), at, latencies.end());
    return *at;
  }
  double percent() const { return 100 * cpu / seconds; }
};

/// Reads with `next`, which returns the counter of the next set, or 0 after some time without one. Sets during the
/// warm-up are not counted, until the rhythm is known or given up.
void measure(Result& result, double rate, double seconds, const std::function<std::uint64_t()>& next) {
  const std::int64_t warm_up = rate > 0 ? 500'000'000 : 3'000'000'000;
  const std::int64_t begin = now_ns() + warm_up, end = begin + static_cast<std::int64_t>(seconds * 1e9);
  std::optional<double> cpu;
  for (std::int64_t now = 0; now < end;) {
    const std::uint64_t counter = next();
    now = now_ns();
    if (now < begin) continue;
    if (!cpu) cpu = cpu_seconds();
    if (counter > 0) result.latencies.push_back(static_cast<double>(now - shared().written[counter]) * 1e-3);
  }
  result.cpu += cpu_seconds() - *cpu;
  result.seconds += static_cast<double>(now_ns() - begin) * 1e-9;
}

wire::CameraParams params_of(std::uint64_t counter) {
  wire::CameraParams params;
  params.format = wire::euler;
  params.euler = {1.2, -2.5, 1.75, 179.9, -5.1, 0.25};
  params.fov = 42.1;
  params.counter = counter;
  return params;
}

const shm::SegmentLayout& layout() { return *shm::layout_of(shm::default_layout); }

/// Writes like existing programs.
std::function<void(std::uint64_t)> field_writer(int id) {
  char* const base = static_cast<char*>(::shmat(id, nullptr, 0));
  return [base](std::uint64_t number) {
    wire::Buffer buffer;
    const auto image = wire::to_image(params_of(number), layout().record, buffer).value();
    auto* const counter = reinterpret_cast<std::uint16_t*>(base + layout().params_counter);
    const auto next = static_cast<std::uint16_t>(*counter + 1U);
    std::memcpy(base + layout().params[next & 1U], image.data(), image.size());
    __atomic_store_n(counter, next, __ATOMIC_RELEASE);
  };
}

enum class WriterOf { field, ours };

void read_by_source(Result& result, double rate, WriterOf writer_of, double seconds) {
  const test::FreeSlot slot;
  shm::Settings settings;
  settings.slot = slot.number();
  // Attached, so that the segment stays.
  const auto segment = shm::Segment::attach_or_create(settings.slot, layout(), 0600).value();
  const auto source = shm::open_source(settings);
  const Writer writer(rate, [&]() -> std::function<void(std::uint64_t)> {
    if (writer_of == WriterOf::field) return field_writer(segment.id());
    return [sink = std::shared_ptr<transport::Sink>(shm::open_sink(settings))](std::uint64_t counter) {
      (void)sink->write(params_of(counter));
    };
  });
  transport::Reception reception;
  measure(result, rate, seconds, [&]() -> std::uint64_t {
    if (source->receive(reception, std::chrono::milliseconds(500)) != transport::Event::sample) return 0;
    return std::get<wire::CameraParams>(reception.sample.record).counter;
  });
}

/// Lower limit of polling: reads the counter every 60 us.
void read_by_poll(Result& result, double rate, WriterOf, double seconds) {
  const test::FreeSlot slot;
  const auto segment = shm::Segment::attach_or_create(slot.number(), layout(), 0600).value();
  const Writer writer(rate, [&] { return field_writer(segment.id()); });
  ::prctl(PR_SET_TIMERSLACK, 1);
  std::uint16_t seen = segment.params_counter();
  measure(result, rate, seconds, [&]() -> std::uint64_t {
    for (int looks = 0; looks < 5000; ++looks) {
      if (segment.params_counter() != seen) return seen = segment.params_counter();
      sleep_until(now_ns() + 60'000);
    }
    return 0;
  });
}

/// Lower limit of an idle reader: sleeps of 100 ms.
void sleep_alone(Result& result, double rate, WriterOf, double seconds) {
  measure(result, rate, seconds, [] {
    sleep_until(now_ns() + 100'000'000);
    return std::uint64_t{0};
  });
}

/// Lower limit of waking a process.
void read_by_futex(Result& result, double rate, WriterOf, double seconds) {
  auto& word = shared().word;
  word = 0;
  const Writer writer(rate, [&word]() -> std::function<void(std::uint64_t)> {
    return [&word](std::uint64_t counter) {
      word = static_cast<std::uint32_t>(counter);
      ::syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
    };
  });
  std::uint32_t seen = 0;
  measure(result, rate, seconds, [&]() -> std::uint64_t {
    const timespec most{0, 500'000'000};
    ::syscall(SYS_futex, &word, FUTEX_WAIT, seen, &most, nullptr, 0);
    if (word == seen) return 0;
    return seen = word;
  });
}

/// The latency of a datagram.
void read_by_socket(Result& result, double rate, WriterOf, double seconds) {
  const int receiver = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const timeval most{0, 500'000};
  ::setsockopt(receiver, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  (void)::bind(receiver, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  ::getsockname(receiver, reinterpret_cast<sockaddr*>(&address), &size);
  {
    const Writer writer(rate, [&address]() -> std::function<void(std::uint64_t)> {
      const int sender = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
      return [sender, &address](std::uint64_t counter) {
        std::array<char, 200> bytes{};
        std::memcpy(bytes.data(), &counter, sizeof counter);
        (void)::sendto(sender, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address),
                       sizeof address);
      };
    });
    measure(result, rate, seconds, [receiver]() -> std::uint64_t {
      std::array<char, 200> bytes{};
      std::uint64_t counter = 0;
      if (::recv(receiver, bytes.data(), bytes.size(), 0) > 0) std::memcpy(&counter, bytes.data(), sizeof counter);
      return counter;
    });
  }
  ::close(receiver);
}

struct Comparison {
  const char* name;
  double rate;
  WriterOf writer;
  void (*peer)(Result&, double, WriterOf, double);
  Result ours{}, theirs{};
};

}  // namespace
}  // namespace trk_bridge

int main(int count, char** arguments) {
  using namespace trk_bridge;
  const double seconds = count > 1 ? std::atof(arguments[1]) : 2;
  const int rounds = count > 2 ? std::atoi(arguments[2]) : 3;
  shared();  // before the first fork
  std::vector<Comparison> comparisons{
      {"plain writer 50 Hz against a poll of 60 us", 50, WriterOf::field, read_by_poll},
      {"plain writer 120 Hz against a poll of 60 us", 120, WriterOf::field, read_by_poll},
      {"own writer 50 Hz against a futex", 50, WriterOf::ours, read_by_futex},
      {"own writer 120 Hz against a futex", 120, WriterOf::ours, read_by_futex},
      {"own writer 120 Hz against a datagram", 120, WriterOf::ours, read_by_socket},
      {"idle against sleeps of 100 ms", 0, WriterOf::field, sleep_alone},
  };
  for (int round = 0; round < rounds; ++round) {
    for (auto& c : comparisons) {
      read_by_source(c.ours, c.rate, c.writer, seconds);
      c.peer(c.theirs, c.rate, c.writer, seconds);
    }
  }
  std::puts("name,ours,peer,unit");
  for (auto& c : comparisons) {
    if (c.rate > 0) {
      std::printf("shm %s: median,%.1f,%.1f,us\n", c.name, c.ours.quantile(0.5), c.theirs.quantile(0.5));
      std::printf("shm %s: p99,%.1f,%.1f,us\n", c.name, c.ours.quantile(0.99), c.theirs.quantile(0.99));
    }
    std::printf("shm %s: reader,%.3f,%.3f,%% of a core\n", c.name, c.ours.percent(), c.theirs.percent());
  }
}
