// While records come and go, nothing is allocated.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>

#include "trk_bridge/base/sequence.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace {
std::atomic<std::uint64_t> allocations{0};
}

// Inlined in part, the pair looks mismatched to the compiler.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace trk_bridge::trk {
namespace {

using endpoints::open_sink;
using endpoints::open_source;
using transport::Event;
using transport::Reception;

void expect_no_allocation(const std::string& options) {
  const auto source = open_source("udp://127.0.0.1:0");
  const auto sink =
      open_sink("udp://127.0.0.1:" + std::to_string(test::port_of(*source)) + "?constants_period=1e-9" + options);
  ASSERT_TRUE(sink->write(test::constants(720, 1)));
  const test::PlainSocket stranger;
  const std::uint16_t port = test::port_of(*source);
  base::Sequence sequence;
  Reception reception;
  std::uint64_t samples = 0, malformed = 0;
  auto params = test::params(0, 1);
  const std::uint64_t before = allocations;
  for (; params.counter < 100; ++params.counter) {
    if (!sink->write(params)) break;
    stranger.send("rubbish", "127.0.0.1", port);
    for (Event event; (event = source->receive(reception, std::chrono::nanoseconds::zero())) != Event::idle;) {
      ++(event == Event::sample ? samples : malformed);
    }
    (void)sequence.judge(params.counter);
  }
  const std::uint64_t during = allocations - before;
  EXPECT_EQ(samples, 201u) << "constants go with every set";
  EXPECT_EQ(malformed, 100u);
  EXPECT_EQ(during, 0u);
}

TEST(Allocation, NoneForAsciiRecords) { expect_no_allocation(""); }
TEST(Allocation, NoneForBinaryRecords) { expect_no_allocation("&binary=1"); }

TEST(Allocation, IsSeenByThisTest) {
  const std::uint64_t before = allocations;
  const auto text = std::make_unique<std::string>(1000, 'x');
  EXPECT_GE(allocations - before, 2u) << text->size();
}

}  // namespace
}  // namespace trk_bridge::trk
