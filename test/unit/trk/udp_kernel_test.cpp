// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What the UDP source asks of the kernel: how large a buffer, and how many system calls.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "error_of.h"
#include "system_calls.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::trk::udp_kernel_test {

using endpoints::open_source;
using test::PlainSocket;
using test::port_of;
using test::SystemCalls;
using transport::Event;
using transport::Reception;

TEST(UdpSourceAndKernel, CountsWhatTheKernelDropped) {
  const auto source = open_source("udp://127.0.0.1:0?buffer=4096");
  const PlainSocket tracker;
  constexpr std::uint64_t sent = 300;
  for (std::uint64_t i = 0; i < sent; ++i) {
    tracker.send(test::datagram(test::params(i)), "127.0.0.1", port_of(*source));
  }
  std::uint64_t received = 0;
  Reception reception;
  while (source->receive(reception, std::chrono::nanoseconds::zero()) == Event::sample) ++received;
  EXPECT_GT(received, 0u);
  EXPECT_GT(source->statistics().kernel_drops, 0u);
  EXPECT_EQ(source->statistics().kernel_drops, sent - received);
}

/// Sends `fields` of 256 cameras without pauses, after their constants.
std::uint64_t send_256_cameras(std::uint16_t port, int fields) {
  const PlainSocket tracker;
  std::uint64_t sent = 0;
  for (std::uint32_t id = 1; id <= 256; ++id, ++sent) {
    tracker.send(test::datagram(test::constants(1920, id)), "127.0.0.1", port);
  }
  for (int field = 0; field < fields; ++field) {
    for (std::uint32_t id = 1; id <= 256; ++id, ++sent) {
      tracker.send(test::datagram(test::params(static_cast<std::uint64_t>(field), id)), "127.0.0.1", port);
    }
  }
  return sent;
}

TEST(UdpSourceAndKernel, BuffersAFifthOfASecondOf256Cameras) {
  const auto source = open_source("udp://127.0.0.1:0");
  const auto s = source->statistics();
  if (s.receive_buffer < s.wanted_buffer) GTEST_SKIP() << "the kernel grants " << s.receive_buffer << " bytes";
  const std::uint64_t sent = send_256_cameras(port_of(*source), 120 / 5);
  std::vector<std::uint64_t> counters(257);
  Reception reception;
  while (source->receive(reception, std::chrono::nanoseconds::zero()) == Event::sample) {
    const auto* params = std::get_if<wire::CameraParams>(&reception.sample.record);
    if (params == nullptr) continue;
    ASSERT_LE(params->id, 256u);
    ASSERT_EQ(params->counter, counters[params->id]++) << "camera " << params->id;
  }
  EXPECT_EQ(source->statistics().records, sent);
  EXPECT_EQ(source->statistics().kernel_drops, 0u);
}

TEST(UdpSourceAndKernel, ReportsTheGrantedReceiveBuffer) {
  EXPECT_EQ(open_source("udp://127.0.0.1:0?buffer=65536")->statistics().receive_buffer, 65536u);
  // Without privileges, net.core.rmem_max at most.
  std::uint64_t most = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> most;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(2);
    const auto s = open_source("udp://127.0.0.1:0")->statistics();
    if (s.wanted_buffer != 8388608 || s.receive_buffer != std::min<std::uint64_t>(most, 8388608)) ::_exit(3);
    const std::string error =
        test::error_of<transport::TransportError>([] { (void)open_source("udp://127.0.0.1:0?buffer=1073741823"); });
    const std::string refusal = "buffer = 1073741823: the kernel grants " + std::to_string(most) + " bytes";
    ::_exit(most >= 1073741823 || error.find(refusal) != std::string::npos ? 0 : 4);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// Of the thread that waits for 100 samples without end. `send(i)` is called before each, or in another thread.
template <typename Before, typename Beside>
std::optional<SystemCalls> calls_of_100(const Before& before, const Beside& beside, bool& is_permitted) {
  return test::system_calls_of(
      [&](const auto& counted) {
        const auto source = open_source("udp://127.0.0.1:0?buffer=1000000");
        const PlainSocket tracker;
        const auto send = [&tracker, port = port_of(*source)](std::uint64_t i) {
          tracker.send(test::datagram(test::params(i)), "127.0.0.1", port);
        };
        bool well = true;
        std::thread sender([&] { beside(send); });
        counted([&] {
          Reception reception;
          for (std::uint64_t i = 0; i < 100; ++i) {
            before(i, send);
            well = well && source->receive(reception, std::chrono::nanoseconds(-1)) == Event::sample &&
                   std::get<wire::CameraParams>(reception.sample.record).counter == i;
          }
        });
        sender.join();
        return well;
      },
      is_permitted);
}

TEST(UdpSourceAndKernel, OneSystemCallPerSample) {
  const auto nothing_beside = [](const auto&) {};
  bool is_permitted = true;
  const auto one_by_one =
      calls_of_100([](std::uint64_t i, const auto& send) { send(i); }, nothing_beside, is_permitted);
  if (!is_permitted) GTEST_SKIP() << "tracing processes is not permitted here";
  EXPECT_EQ(one_by_one, (SystemCalls{{SYS_sendto, 100}, {SYS_recvmmsg, 100}}));

  const auto at_once = calls_of_100(
      [](std::uint64_t i, const auto& send) {
        for (std::uint64_t k = 0; i == 0 && k < 100; ++k) send(k);
      },
      nothing_beside, is_permitted);
  ASSERT_TRUE(at_once.has_value());
  EXPECT_EQ(at_once->at(SYS_sendto), 100);
  EXPECT_LE(test::total(*at_once), 100 + 10) << "waiting datagrams are received many at a time";

  const auto waited_for = calls_of_100([](std::uint64_t, const auto&) {},
                                       [](const auto& send) {
                                         for (std::uint64_t i = 0; i < 100; ++i) {
                                           std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                           send(i);
                                         }
                                       },
                                       is_permitted);
  ASSERT_TRUE(waited_for.has_value());
  EXPECT_EQ(waited_for->size(), 1u) << "of one kind";
  EXPECT_LE(waited_for->at(SYS_recvmmsg), 100);
}

}  // namespace trk_bridge::trk::udp_kernel_test
