// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Ten faults of real studios: whether the monitor names each as the first one within five seconds.
//
// Datagrams are received by a real UDP source on the loopback. Times are simulated, so that rates and stalls are exact
// and no test waits for a clock.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monitor/model.h"
#include "network_namespace.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "udp.h"

namespace trk_bridge::monitor::findings_test {

using bridge::Condition;
using std::chrono::nanoseconds;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t five_seconds = 5000 * ms;

/// A source, and a model that watches it, on a simulated clock.
class Studio {
 public:
  explicit Studio(const std::string& options = "", const std::string& address = "127.0.0.1")
      : address_(address), source_(endpoints::open_source("udp://" + address + ":0" + options)) {}

  std::uint16_t port() const { return test::port_of(*source_); }
  const std::string& address() const { return address_; }

  /// The datagram arrives `at` after the start, if the source accepts it.
  void send(const test::PlainSocket& from, const std::string& datagram, std::int64_t at) {
    const auto before = source_->statistics();
    from.send(datagram, address_, port());
    transport::Reception reception;
    const auto is_counted = [&] { return source_->statistics().refused > before.refused; };
    const auto end = std::chrono::steady_clock::now() + test::deadline;
    while (std::chrono::steady_clock::now() < end) {
      const auto event = source_->receive(reception, std::chrono::milliseconds(1));
      reception.sample.arrival = today + at;
      if (event == transport::Event::sample) return model_.add(reception.sample, begin_ + nanoseconds(at));
      if (event == transport::Event::malformed) return model_.add_malformed(reception, begin_ + nanoseconds(at));
      if (is_counted()) return;
    }
    FAIL() << "the datagram was not received";
  }
  State state(std::int64_t at) { return model_.state(begin_ + nanoseconds(at), *source_); }

 private:
  static constexpr std::int64_t today = 1'795'000'000'000 * ms;

  const std::string address_;
  const std::unique_ptr<transport::Source> source_;
  const Model::Time begin_{std::chrono::hours(5)};
  Model model_{begin_};
};

/// One camera's records, with constants every second.
class Tracker {
 public:
  Tracker(Studio& studio, std::uint32_t id, const std::string& address = "127.0.0.1")
      : studio_(studio), socket_(address), id_(id) {}

  void send(std::uint64_t counter, std::int64_t at) {
    if (has_constants && sent_++ % 50 == 0) studio_.send(socket_, test::datagram(test::constants(720, id_)), at);
    studio_.send(socket_, test::datagram(test::params(counter, id_)), at);
  }
  void send_raw(const std::string& datagram, std::int64_t at) { studio_.send(socket_, datagram, at); }

  bool has_constants = true;

 private:
  Studio& studio_;
  test::PlainSocket socket_;
  std::uint32_t id_;
  std::uint64_t sent_ = 0;
};

/// Updates ten times a second, like the screen, until the first finding is the expected one; returns the last state.
State watched(Studio& studio, Condition condition, std::int64_t interval,
              const std::function<void(std::uint64_t n, std::int64_t at)>& send) {
  State state;
  std::int64_t looked = 0;
  std::uint64_t n = 0;
  for (std::int64_t at = 0; at <= five_seconds; at += interval, ++n) {
    send(n, at);
    if (at - looked < 100 * ms) continue;
    looked = at;
    state = studio.state(at);
    if (state.findings.front().condition == condition) return state;
  }
  return state;
}

std::string all(const State& state) {
  std::string text;
  for (const auto& finding : state.findings) text += finding.text + "\n";
  return text;
}

#define EXPECT_FIRST(state, expected_condition, text_matcher)                                 \
  EXPECT_EQ((state).findings.front().condition, Condition::expected_condition) << all(state); \
  EXPECT_THAT((state).findings.front().text, text_matcher)

TEST(TenFaults, NothingIsWrong) {
  Studio studio;
  Tracker tracker(studio, 7);
  for (std::uint64_t n = 0; n <= 250; ++n) {
    const auto at = static_cast<std::int64_t>(n) * 20 * ms;
    tracker.send(1000 + n, at);
    const auto state = studio.state(at);
    ASSERT_EQ(state.findings.front().level, bridge::Level::ok) << all(state);
  }
  EXPECT_FIRST(studio.state(five_seconds), receiving, HasSubstr("id 7: receiving from 127.0.0.1:"));
}

TEST(Findings, SeveralCamerasWithoutFaultsAreOneLine) {
  Studio studio;
  Tracker one(studio, 1), two(studio, 2);
  for (std::uint64_t n = 0; n <= 50; ++n) {
    one.send(n, static_cast<std::int64_t>(n) * 20 * ms);
    two.send(n, static_cast<std::int64_t>(n) * 20 * ms);
  }
  EXPECT_EQ(all(studio.state(1000 * ms)), "nothing is wrong: 2 cameras are received\n");
}

TEST(TenFaults, One_ARateThatIsNotTheOneExpected) {
  Studio studio;
  Tracker tracker(studio, 7);
  const auto state =
      watched(studio, Condition::rate, 1001 * ms / 60, [&](std::uint64_t n, std::int64_t at) { tracker.send(n, at); });
  EXPECT_FIRST(state, rate, "id 7: the rate is 59.94 Hz, not 60");
}

TEST(TenFaults, Two_Stalls) {
  Studio studio;
  Tracker tracker(studio, 7);
  // Every second the records of 240 ms are held back and sent together.
  const auto state = watched(studio, Condition::stalls, 20 * ms, [&](std::uint64_t n, std::int64_t at) {
    const std::uint64_t of_second = n % 50;
    if (of_second < 38) return tracker.send(n, at);
    for (std::uint64_t held = n - 11; of_second == 49 && held <= n; ++held) tracker.send(held, at);
  });
  EXPECT_FIRST(
      state, stalls,
      AllOf(HasSubstr("id 7: arrivals stall: "), HasSubstr(" for up to 240 ms; then 12 records arrived at once")));
}

TEST(TenFaults, Three_Bursts) {
  Studio studio;
  Tracker tracker(studio, 7);
  const auto state = watched(studio, Condition::bursts, 100 * ms, [&](std::uint64_t n, std::int64_t at) {
    for (std::uint64_t k = 0; k < 5; ++k) tracker.send(5 * n + k, at);
  });
  EXPECT_FIRST(state, bursts, "id 7: records arrive in bursts: 5 at once every 100 ms, not one every 20 ms");
}

TEST(TenFaults, Four_TheWrongSender) {
  Studio studio("?allow=127.0.0.9");
  Tracker tracker(studio, 7, "127.0.0.3");
  const auto state =
      watched(studio, Condition::only_refused, 20 * ms, [&](std::uint64_t n, std::int64_t at) { tracker.send(n, at); });
  EXPECT_FIRST(state, only_refused, AllOf(HasSubstr("not allowed"), HasSubstr("127.0.0.3:")));
}

TEST(TenFaults, Five_TwoSendersOfOneId) {
  Studio studio;
  Tracker one(studio, 7, "127.0.0.2"), other(studio, 7, "127.0.0.3");
  const auto state = watched(studio, Condition::foreign_sender, 20 * ms, [&](std::uint64_t n, std::int64_t at) {
    one.send(n, at);
    other.send(90'000 + n, at);
  });
  EXPECT_FIRST(state, foreign_sender,
               AllOf(HasSubstr("id 7: two senders use this id: 127.0.0.2:"), HasSubstr(" and 127.0.0.3:")));
}

class ATimeCodeAsCounter
    : public testing::TestWithParam<std::pair<const char*, std::function<std::uint64_t(std::uint64_t)>>> {};

TEST_P(ATimeCodeAsCounter, Six) {
  Studio studio;
  Tracker tracker(studio, 7);
  const auto& [text, counter] = GetParam();
  const auto state =
      watched(studio, Condition::time_code_counter, 40 * ms,
              [&, &counter = counter](std::uint64_t n, std::int64_t at) { tracker.send(counter(n), at); });
  EXPECT_FIRST(state, time_code_counter, AllOf(HasSubstr("id 7: the counter is a time code ("), HasSubstr(text)));
  EXPECT_THAT(all(state), testing::Not(HasSubstr(": lost")));
}

// From 10:20:58:00 on, so that a new minute starts.
std::uint64_t parts(std::uint64_t n, std::uint64_t base) {
  const std::uint64_t second = 58 + n / 25;
  return ((10 * base + 20 + second / 60) * base + second % 60) * base + n % 25;
}
INSTANTIATE_TEST_SUITE_P(
    TenFaults, ATimeCodeAsCounter,
    testing::Values(std::pair{"as decimal digits", [](std::uint64_t n) { return parts(n, 100); }},
                    std::pair{"with a byte for each part", [](std::uint64_t n) { return parts(n, 256); }},
                    std::pair{"as binary coded decimals",
                              [](std::uint64_t n) { return std::stoull(std::to_string(parts(n, 100)), nullptr, 16); }},
                    std::pair{"its frame number alone, 0 to 24", [](std::uint64_t n) { return n % 25; }}));

TEST(TenFaults, Seven_NoConstants) {
  Studio studio;
  Tracker tracker(studio, 7);
  tracker.has_constants = false;
  const auto state =
      watched(studio, Condition::no_constants, 20 * ms, [&](std::uint64_t n, std::int64_t at) { tracker.send(n, at); });
  EXPECT_FIRST(state, no_constants, HasSubstr("id 7: no constants received"));
}

TEST(TenFaults, Eight_ASenderOnAnotherInterface) {
  Studio studio("", "127.0.0.2");
  const test::PlainSocket sender;
  const auto state = watched(studio, Condition::other_interface, 20 * ms, [&](std::uint64_t n, std::int64_t) {
    // No socket receives there. The kernel reports that to the sender, which ignores it.
    const auto to = test::datagram(test::params(n, 7));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(studio.port());
    ::inet_pton(AF_INET, "127.0.0.3", &address.sin_addr);
    (void)::sendto(sender.fd(), to.data(), to.size(), 0, reinterpret_cast<sockaddr*>(&address), sizeof address);
  });
  EXPECT_FIRST(
      state, other_interface,
      AllOf(HasSubstr("nothing is received by udp port " + std::to_string(studio.port()) + " on 127.0.0.2, but "),
            HasSubstr("another interface, address or port")));
}

/// A machine with two interfaces, and a tracker with two. Throws if network namespaces are not available.
struct TwoNetworks {
  test::NetworkNamespace studio, tracker;

  TwoNetworks() {
    studio.ip("link add one type veth peer name one netns " + tracker.path() +
              "\nlink add two type veth peer name two netns " + tracker.path());
    for (const auto* side : {&studio, &tracker}) {
      const std::string last = side == &studio ? ".1/24" : ".2/24";
      side->ip("addr add 10.77.1" + last + " dev one\naddr add 10.77.2" + last +
               " dev two\nlink set one up\nlink set two up");
    }
    // The filter also drops the address request (ARP).
    studio.ip("link set one address 02:00:00:00:01:01");
    tracker.ip("neigh add 10.77.1.1 lladdr 02:00:00:00:01:01 dev one nud permanent");
    const test::NetworkNamespace::Stay stay(studio);
    std::ofstream filter("/proc/sys/net/ipv4/conf/all/rp_filter");
    if (!(filter << 1 << std::flush)) throw std::runtime_error("rp_filter cannot be set");
  }
};

TEST(TenFaults, Eight_ASenderWhoseWayBackIsAnotherInterface) {
  std::unique_ptr<TwoNetworks> networks;
  try {
    networks = std::make_unique<TwoNetworks>();
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  std::unique_ptr<test::PlainSocket> sender;
  {
    const test::NetworkNamespace::Stay stay(networks->tracker);
    sender = std::make_unique<test::PlainSocket>("10.77.2.2");
  }
  const test::NetworkNamespace::Stay stay(networks->studio);
  Studio studio("", "10.77.1.1");
  const auto state = watched(studio, Condition::other_interface, 20 * ms, [&](std::uint64_t n, std::int64_t) {
    sender->send(test::datagram(test::params(n, 7)), "10.77.1.1", studio.port());
  });
  EXPECT_FIRST(state, other_interface, HasSubstr("through another interface (reverse path filter)"));
}

TEST(TenFaults, Nine_LossOnTheWay) {
  Studio studio;
  Tracker tracker(studio, 7);
  const auto state = watched(studio, Condition::lost, 20 * ms, [&](std::uint64_t n, std::int64_t at) {
    if (n % 10 != 9) tracker.send(n, at);
  });
  EXPECT_FIRST(state, lost, AllOf(HasSubstr("id 7: lost "), HasSubstr(" %)")));
}

TEST(TenFaults, Ten_AnotherProtocol) {
  Studio studio;
  Tracker tracker(studio, 7);
  const auto state = watched(studio, Condition::nothing_valid, 20 * ms,
                             [&](std::uint64_t, std::int64_t at) { tracker.send_raw("GET / HTTP/1.1\r\n", at); });
  EXPECT_FIRST(state, nothing_valid, HasSubstr("none is trk"));
}

TEST(Findings, ACountThatIsNotATimeCodeIsNotReported) {
  for (const std::uint64_t begin : {0U, 90U, 2'000U, 10'205'900U, 0x10205900U}) {
    TimeCodeCounter counter;
    for (std::uint64_t n = 0; n < 2000; ++n) {
      counter.add(begin + n);
      ASSERT_FALSE(counter.description()) << begin + n;
    }
  }
}

TEST(Findings, AGapOfLostRecordsIsNotAStall) {
  ArrivalWindow arrivals;
  for (std::int64_t n = 0; n < 500; ++n) {
    if (n % 100 < 80) arrivals.add(n * 20 * ms, n % 100 == 0 ? 21 : 1);
  }
  EXPECT_EQ(arrivals.unevenness().kind, Unevenness::Kind::none);
}

TEST(Findings, APauseThatLosesNothingIsAStall) {
  ArrivalWindow arrivals;
  for (std::int64_t n = 0; n < 200; ++n) arrivals.add(n * 20 * ms + (n >= 100 ? 300 * ms : 0));
  const auto found = arrivals.unevenness();
  EXPECT_EQ(found.kind, Unevenness::Kind::stalls);
  EXPECT_EQ(found.longest, 320 * ms);
  EXPECT_EQ(found.at_once, 1U);
}

TEST(Findings, LossIsThatOfTheLastSeconds) {
  Studio studio;
  Tracker tracker(studio, 7);
  tracker.send(0, 0);
  tracker.send(9, 20 * ms);
  EXPECT_FIRST(studio.state(20 * ms), lost, HasSubstr("lost 8 of 10 records"));
  EXPECT_DOUBLE_EQ(studio.state(20 * ms).cameras.front().loss.value(), 80);
  for (std::uint64_t n = 0; n < 600; ++n) {
    tracker.send(10 + n, static_cast<std::int64_t>(2 + n) * 20 * ms);
    (void)studio.state(static_cast<std::int64_t>(2 + n) * 20 * ms);
  }
  const auto state = studio.state(601 * 20 * ms);
  EXPECT_FIRST(state, receiving, HasSubstr("receiving from"));
  EXPECT_DOUBLE_EQ(state.cameras.front().loss.value(), 0);
}

}  // namespace trk_bridge::monitor::findings_test
