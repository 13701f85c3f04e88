// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// ros_to_trk with sinks that fail or block: none disturbs another, each reports its problem, and the node ends soon.
//
// In private namespaces for networks and mounts, which need root.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/shm.h>
#include <sys/stat.h>

#include "free_slot.h"
#include "hung_storage.h"
#include "node_process.h"
#include "params_publisher.h"
#include "temporary_directory.h"
#include "transport/socket.h"
#include "udp.h"
#include "whole_take.h"

namespace trk_bridge::test::outputs_test {

using diagnostic_msgs::DiagnosticStatus;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::HasSubstr;

/// Created before the master and all other processes, which run in them.
const bool has_namespaces = ::unshare(CLONE_NEWNET | CLONE_NEWNS) == 0 &&
                            ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                            std::system("ip link set lo up") == 0;

/// A UDP receiver that records when each set arrived.
class LiveReceiver {
 public:
  LiveReceiver()
      : thread_([this] {
          while (!stops_) {
            const auto datagram = socket_.receive(milliseconds(50));
            if (!datagram) continue;
            wire::LayoutDetector detector;
            const auto read = wire::decode(*datagram, detector);
            const auto* params = read ? std::get_if<wire::CameraParams>(&read->record) : nullptr;
            if (params == nullptr) continue;
            const std::lock_guard<std::mutex> lock(mutex_);
            received_.emplace_back(params->counter, steady_clock::now());
          }
        }) {}
  ~LiveReceiver() {
    stops_ = true;
    thread_.join();
  }
  LiveReceiver(const LiveReceiver&) = delete;
  LiveReceiver& operator=(const LiveReceiver&) = delete;

  std::string url() const { return "udp://127.0.0.1:" + std::to_string(socket_.port()); }
  std::vector<std::pair<std::uint64_t, steady_clock::time_point>> received() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return received_;
  }

 private:
  const PlainSocket socket_;
  mutable std::mutex mutex_;
  std::vector<std::pair<std::uint64_t, steady_clock::time_point>> received_;
  std::atomic<bool> stops_{false};
  std::thread thread_;
};

/// One sink with a problem before a working one.
class Outputs : public NodeProcessTest {
 protected:
  Outputs() : NodeProcessTest(ROS_TO_TRK) {}
  void SetUp() override {
    if (!has_namespaces) GTEST_SKIP() << "no namespaces for networks and mounts: root is needed";
  }

  void start_with(const std::string& in_trouble) {
    bad = in_trouble;
    set("sinks", std::vector<std::string>{bad, live.url()});
    set("queue_size", 10000);
    set("diagnostic_period", 0.5);
    publisher.emplace(name_space);
    ASSERT_TRUE(starts());
    ASSERT_TRUE(eventually([&] { return publisher->has_subscribers(); }));
    publisher->publish(constants());
    ASSERT_TRUE(diagnostics.becomes(status_name(), "constants known", "received"));
  }

  /// Publishes 50 sets a second until `meanwhile` has returned and `count` sets have been sent; expects all of them, in
  /// order and without delay, at the working one.
  void expect_live(
      std::uint64_t count, const std::function<void()>& meanwhile = [] {}) {
    std::map<std::uint64_t, steady_clock::time_point> sent_at;
    std::atomic<bool> done{false};
    std::thread sender([&] {
      auto due = steady_clock::now();
      for (std::uint64_t i = 0; i < count || !done; ++i) {
        std::this_thread::sleep_until(due += milliseconds(20));
        sent_at[++sent] = steady_clock::now();
        publisher->publish(params(sent));
      }
    });
    const auto before = live.received().size();
    meanwhile();
    done = true;
    sender.join();
    EXPECT_TRUE(eventually([&] { return live.received().size() - before >= sent_at.size(); }));
    auto received = live.received();
    received.erase(received.begin(), received.begin() + static_cast<std::ptrdiff_t>(before));
    ASSERT_EQ(received.size(), sent_at.size()) << "none is missing";
    std::vector<double> delays, gaps;
    std::uint64_t expected = sent_at.begin()->first;
    for (const auto& [counter, time] : received) {
      ASSERT_EQ(counter, expected++);
      delays.push_back(std::chrono::duration<double, std::milli>(time - sent_at[counter]).count());
    }
    for (std::size_t i = 1; i < received.size(); ++i) {
      gaps.push_back(std::chrono::duration<double, std::milli>(received[i].second - received[i - 1].second).count());
    }
    std::sort(delays.begin(), delays.end());
    std::sort(gaps.begin(), gaps.end());
    const auto print = [](const char* what, const std::vector<double>& sorted) {
      if (sorted.empty()) return;
      std::printf("%s of %zu: median %.2f, 95 %% %.2f, most %.2f ms\n", what, sorted.size(), sorted[sorted.size() / 2],
                  sorted[sorted.size() * 95 / 100], sorted.back());
    };
    print("delays", delays);
    print("gaps", gaps);
    // If it waited for the other sink, it would be 200 ms late, and later with every set.
    EXPECT_LT(delays[delays.size() / 2], 100);
    EXPECT_LT(delays.back(), 2000);
  }

  /// Expects that SIGINT ends it soon; returns its output at the end.
  std::string end(int number = SIGINT) {
    const auto begin = steady_clock::now();
    node->signal(number);
    std::string output = node->rest_of_err();
    EXPECT_EQ(node->wait(), 0);
    const auto took = std::chrono::duration<double>(steady_clock::now() - begin).count();
    std::printf("ended after %.2f s\n", took);
    EXPECT_LT(took, 5);
    return output;
  }

  ::testing::AssertionResult bad_reports(int level, const std::string& text) {
    return diagnostics.reports(status_name(bad), level, text);
  }
  void expect_live_is_ok() {
    EXPECT_TRUE(diagnostics.reports(status_name(live.url()), DiagnosticStatus::OK, "sending at"));
    EXPECT_EQ(diagnostics.value(status_name(live.url()), "errors"), "0");
  }

  const TemporaryDirectory folder;
  LiveReceiver live;
  std::optional<ParamsPublisher> publisher;
  std::string bad;
  std::uint64_t sent = 0;
};

TEST_F(Outputs, ASegmentThatIsNeverFinished) {
  FreeSlot slot;
  slot.make_segment(544);
  ASSERT_NO_FATAL_FAILURE(start_with("shm:" + std::to_string(slot.number())));
  expect_live(250, [&] {
    EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "nothing is sent: shm slot " + std::to_string(slot.number())));
    expect_live_is_ok();
  });
  end();
}

TEST_F(Outputs, ASegmentOfUnknownSize) {
  FreeSlot slot;
  slot.make_segment(12345);
  ASSERT_NO_FATAL_FAILURE(start_with("shm:" + std::to_string(slot.number())));
  expect_live(100, [&] {
    EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "12345"));
    expect_live_is_ok();
  });
  slot.remove();
  expect_live(1, [&] { EXPECT_TRUE(bad_reports(DiagnosticStatus::OK, "sending at")); });
  end();
}

TEST_F(Outputs, SegmentsThatAppearAndDisappearWithAnyContent) {
  FreeSlot slot;
  ASSERT_NO_FATAL_FAILURE(start_with("shm:" + std::to_string(slot.number())));
  std::atomic<bool> done{false};
  std::thread hostile([&] {
    for (unsigned round = 0; !done; ++round) {
      const std::size_t sizes[] = {544, 528, 524, 508, 12, 4096};
      try {
        slot.remove();
        const int id = slot.make_segment(sizes[round % std::size(sizes)]);
        void* memory = ::shmat(id, nullptr, 0);
        if (memory != reinterpret_cast<void*>(-1)) {
          std::memset(memory, static_cast<int>(round * 37), sizes[round % std::size(sizes)]);
          ::shmdt(memory);
        }
      } catch (const std::runtime_error&) {
        // The node was first.
      }
      std::this_thread::sleep_for(milliseconds(7));
    }
  });
  expect_live(250, [&] { expect_live_is_ok(); });
  EXPECT_NE(diagnostics.find(status_name(bad))->level, DiagnosticStatus::OK);
  end();
  done = true;
  hostile.join();
}

TEST_F(Outputs, AFullDisk) {
  ASSERT_EQ(::mount("trk_bridge_test", folder.path().c_str(), "tmpfs", 0, "size=16k"), 0);
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + folder / "take.trk"));
  expect_live(400, [&] {
    EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "nothing is sent: the system refused: No space left on device"));
    expect_live_is_ok();
  });
  end();
  const auto take = file::read_take(folder / "take.trk");
  EXPECT_GT(take.params.size(), 50u);
  EXPECT_LT(take.params.size(), sent);
  for (std::size_t i = 0; i < take.params.size(); ++i) EXPECT_EQ(take.params[i].counter, i + 1);
  ::umount2(folder.path().c_str(), MNT_DETACH);
}

TEST_F(Outputs, ADiskThatIsFullFromTheStart) {
  ASSERT_EQ(::mount("trk_bridge_test", folder.path().c_str(), "tmpfs", 0, "size=16k"), 0);
  std::ofstream(folder / "filler") << std::string(65536, 'x');
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + folder / "take.trk"));
  EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "take.trk: cannot be written: the system refused: No space left"));
  expect_live(100, [&] { expect_live_is_ok(); });
  std::filesystem::remove(folder / "filler");
  expect_live(1, [&] { EXPECT_TRUE(bad_reports(DiagnosticStatus::OK, "sending at")); });
  end();
  EXPECT_EQ(file::read_take(folder / "take.trk").params.back().counter, sent);
  ::umount2(folder.path().c_str(), MNT_DETACH);
}

TEST_F(Outputs, StorageThatDoesNotAnswer) {
  const HungStorage storage(folder.path());
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + folder / "take.trk"));
  expect_live(200, [&] {
    EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "nothing is sent: no answer for "));
    expect_live_is_ok();
  });
  const std::string output = end();
  EXPECT_THAT(output, HasSubstr("take.trk was not closed in order: it does not respond and was abandoned; "));
  EXPECT_THAT(output, HasSubstr(" queued records are lost"));
}

TEST_F(Outputs, AFifoWithoutReader) {
  const std::string fifo = folder / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const transport::Descriptor reader(::open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  ASSERT_EQ(::fcntl(reader.get(), F_SETPIPE_SZ, 4096), 4096);
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + fifo));
  expect_live(250, [&] {
    EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "nothing is sent: no answer for "));
    expect_live_is_ok();
  });
  EXPECT_THAT(end(), HasSubstr("fifo was not closed in order: it does not respond and was abandoned; "));
}

TEST_F(Outputs, AHostWithoutRoute) {
  ASSERT_NO_FATAL_FAILURE(start_with("udp://192.0.2.1:7000"));
  expect_live(200, [&] {
    EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "nothing is sent: the system refused: Network is unreachable"));
    expect_live_is_ok();
  });
  end();
}

TEST_F(Outputs, ATakeThatExists) {
  write_text(folder / "take.trk", "precious");
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + folder / "take.trk"));
  EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "take.trk: cannot be written: it exists; to overwrite it, use"));
  expect_live(100, [&] { expect_live_is_ok(); });
  // Its queue has a thread of its own.
  const std::uint64_t refused = sent;
  EXPECT_TRUE(diagnostics.becomes(status_name(bad), "errors", std::to_string(refused)));
  EXPECT_EQ(read_text(folder / "take.trk"), "precious");
  std::filesystem::remove(folder / "take.trk");
  expect_live(1, [&] { EXPECT_TRUE(bad_reports(DiagnosticStatus::OK, "sending at")); });
  end();
  const auto take = file::read_take(folder / "take.trk");
  EXPECT_GT(take.params.front().counter, refused);
  EXPECT_EQ(take.params.back().counter, sent);
}

TEST_F(Outputs, AMissingFolder) {
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + folder / "absent/take.trk"));
  EXPECT_TRUE(bad_reports(DiagnosticStatus::ERROR, "absent/take.trk: cannot be written: the system refused: No such"));
  expect_live(50);
  end();
}

/// How the node as a separate process handles a recording.
class NodeRecording : public Outputs {
 protected:
  void record(std::uint64_t count) {
    const auto before = sent;
    expect_live(count, [&] { EXPECT_TRUE(bad_reports(DiagnosticStatus::OK, "sending at")); });
    EXPECT_TRUE(diagnostics.becomes(status_name(bad), "sent", std::to_string(sent - before)));
  }
};

TEST_F(NodeRecording, IsNamedByTheStampOfItsFirstField) {
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + folder / "crane-%Y%m%d-%H%M%S.trk"));
  publisher->publish(params(1), ::ros::Time(1'795'342'830, 500'000'000));
  const std::string name = folder / "crane-20261122-102030.trk";
  EXPECT_TRUE(diagnostics.becomes(status_name(bad), "sink", "file " + name));
  end();
  EXPECT_EQ(base::to_string(file::read_take(name).time_code), "10:20:30:12:2");
}

TEST_F(NodeRecording, IsRecoveredWhenTheNodeWasKilled) {
  const std::string take = folder / "take.trk";
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + take));
  record(100);
  const auto recorded = sent;
  node->signal(SIGKILL);
  node->rest_of_err();
  node->wait();
  ASSERT_TRUE(starts());
  EXPECT_TRUE(bad_reports(DiagnosticStatus::OK, "take.recovered.trk"));
  EXPECT_EQ(file::read_take(folder / "take.recovered.trk").params.size(), recorded);
  end();
}

TEST_F(NodeRecording, SurvivesTwoSignalsOfAnyKind) {
  for (const auto& [first, second] : {std::pair(SIGINT, SIGINT), {SIGINT, SIGTERM}, {SIGTERM, SIGTERM}}) {
    const std::string take = folder / ("take" + std::to_string(first) + std::to_string(second) + ".trk");
    ASSERT_NO_FATAL_FAILURE(start_with("file:" + take));
    record(20);
    const auto recorded = sent;
    node->signal(first);
    std::this_thread::sleep_for(std::chrono::microseconds(500));
    end(second);
    EXPECT_EQ(file::read_take(take).params.back().counter, recorded);
  }
}

TEST_F(NodeRecording, DoesNotBecomeAStandardDescriptorThatWasClosed) {
  launcher = {"/bin/sh", "-c", "exec \"$@\" 0<&- 1>&- 2>&-", "sh"};
  ASSERT_NO_FATAL_FAILURE(start_with("file:" + folder / "take.trk"));
  record(20);
  end();
  EXPECT_EQ(file::read_take(folder / "take.trk").params.back().counter, sent);
}

}  // namespace trk_bridge::test::outputs_test
