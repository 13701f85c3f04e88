// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A sender that never pauses and sends nothing useful: a time limit and stop() still end receive().
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <memory>
#include <string_view>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "deadline.h"
#include "transport/datagram.h"

namespace {

/// While set, every datagram that is read is from 127.0.0.6, and there is always another one. A real sender is not
/// always faster than its receiver.
std::atomic<bool> is_flooded{false};
std::atomic<std::uint64_t> batches{0};  // read of the flood

}  // namespace

extern "C" __attribute__((visibility("default"))) int recvmmsg(int fd, mmsghdr* messages, unsigned count, int flags,
                                                               timespec* timeout) {
  if (!is_flooded) return static_cast<int>(::syscall(SYS_recvmmsg, fd, messages, count, flags, timeout));
  for (unsigned i = 0; i < count; ++i) {
    auto& sender = *static_cast<sockaddr_in*>(messages[i].msg_hdr.msg_name);
    sender = {};
    sender.sin_family = AF_INET;
    sender.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 5);
    messages[i].msg_hdr.msg_namelen = sizeof sender;
    messages[i].msg_hdr.msg_controllen = 0;
    messages[i].msg_hdr.msg_flags = 0;
    messages[i].msg_len = 1;
  }
  ++batches;
  return static_cast<int>(count);
}

namespace trk_bridge::transport::datagram_flood_test {

/// Has nothing to decode.
class Silent final : public Decoder {
 public:
  void begin(std::string_view, const Sender&) noexcept override {}
  Next next(Sample&, Fault&) noexcept override { return Next::none; }
};

/// The filter drops the complete flood, or nothing; then no datagram of it contains a sample.
class DatagramFloodTest : public testing::TestWithParam<const char*> {
 protected:
  ~DatagramFloodTest() override { is_flooded = false; }

  /// receive() in a thread.
  std::future<Event> receive(std::chrono::nanoseconds wait) {
    return std::async(std::launch::async, [this, wait] { return source->receive(reception, wait); });
  }
  /// The result of `receiving`; `malformed`, which does not occur here, if it does not end.
  Event event_of(std::future<Event> receiving) {
    const bool has_ended = receiving.wait_for(test::deadline) == std::future_status::ready;
    is_flooded = false;
    source->stop();
    return has_ended ? receiving.get() : Event::malformed;
  }

  std::unique_ptr<Source> source = [] {
    ReceiveSettings settings;
    settings.host = "127.0.0.1";
    settings.allow = {GetParam()};
    return open_datagram_source(settings, std::make_unique<Silent>());
  }();
  Reception reception;
};

TEST_P(DatagramFloodTest, StopEndsReceive) {
  is_flooded = true;
  const std::uint64_t before = batches;
  auto receiving = receive(std::chrono::nanoseconds(-1));
  const auto until = std::chrono::steady_clock::now() + test::deadline;
  while (batches < before + 1000 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  source->stop();
  EXPECT_EQ(event_of(std::move(receiving)), Event::stopped);
}

TEST_P(DatagramFloodTest, AWaitEndsReceive) {
  is_flooded = true;
  EXPECT_EQ(event_of(receive(std::chrono::milliseconds(1))), Event::idle);
}

TEST_P(DatagramFloodTest, ZeroWaitEndsReceive) {
  is_flooded = true;
  EXPECT_EQ(event_of(receive(std::chrono::nanoseconds(0))), Event::idle);
}

INSTANTIATE_TEST_SUITE_P(Allowed, DatagramFloodTest, testing::Values("127.0.0.5", "127.0.0.6"));

}  // namespace trk_bridge::transport::datagram_flood_test
