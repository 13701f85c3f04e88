// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// ros_to_trk: messages as input; UDP, shared memory and files as output; its start and end.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include <trk_bridge/CameraParams.h>

#include "free_slot.h"
#include "node_process.h"
#include "params_publisher.h"
#include "receiver.h"
#include "temporary_directory.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "whole_take.h"

namespace trk_bridge::test::outgoing_test {

using diagnostic_msgs::DiagnosticStatus;
using ::testing::AllOf;
using ::testing::HasSubstr;

class OutgoingRefused : public RosToTrkTest {};

TEST_F(OutgoingRefused, FaultsOfParametersAreNamed) {
  set_sinks({"udp://127.0.0.1:7000", "tcp://127.0.0.1:7000"});
  set("preset", "brainstrom");
  set("input", "tf");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~sinks = 'tcp://127.0.0.1:7000'"), HasSubstr("nearest is brainstorm"),
                               HasSubstr("~chip_width = (none)")));
}

TEST_F(OutgoingRefused, AnUnknownParameterIsNamedWithTheNearestKnown) {
  set("sink", "udp://127.0.0.1:7000");
  EXPECT_THAT(refusal(), HasSubstr("~sink = 'udp://127.0.0.1:7000': unknown parameter, nearest is sinks"));
}

TEST_F(OutgoingRefused, AnAddressThatCannotBeSentToIsNamed) {
  set_sinks({"udp://0.0.0.0:7000"});
  EXPECT_THAT(refusal(), HasSubstr("0.0.0.0"));
}

/// As a process.
class OutgoingStartup : public NodeProcessTest {
 protected:
  OutgoingStartup() : NodeProcessTest(ROS_TO_TRK) { set("sinks", std::vector<std::string>{receiver.url()}); }

  const Receiver receiver;
};

TEST_F(OutgoingStartup, WithoutSinksItEndsAndNamesWhatIsMissing) {
  ::ros::param::del(node_name + "/sinks");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~sinks = []"), HasSubstr("must be given")));
}

TEST_F(OutgoingStartup, SigintEndsItPromptly) {
  ASSERT_TRUE(starts());
  EXPECT_LT(interrupted(), std::chrono::seconds(3));
}

TEST_F(OutgoingStartup, SigintEndsItPromptlyWhileItReadsTf) {
  set("input", "tf");
  set("chip_width", 9.59);
  set("chip_height", 5.39);
  ASSERT_TRUE(starts());
  EXPECT_LT(interrupted(), std::chrono::seconds(3));
}

class FromParams : public RosToTrkTest {
 protected:
  void open(const std::vector<std::string>& sinks) {
    set_sinks(sinks);
    set("queue_size", 10000);
    publisher.emplace(name_space);
    ASSERT_TRUE(starts());
    ASSERT_TRUE(publisher->has_subscribers());
  }

  void publish(const wire::CameraParams& record) const { publisher->publish(record); }
  /// Waits until the node knows them.
  void publish(const wire::CameraConstants& record) {
    publisher->publish(record);
    ASSERT_TRUE(diagnostics.becomes(status_name(), "constants known", "received"));
  }

  std::optional<ParamsPublisher> publisher;
  Receiver receiver;
};

TEST_F(FromParams, RecordsThatNeedNoChangeAreSentUnchanged) {
  ASSERT_NO_FATAL_FAILURE(open({receiver.url()}));
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::STALE, "no messages on " + name_space + "/params"));
  auto record = params(1000, 7);
  record.euler.pan = 30.1;
  record.k1 = 1e-4 / 3;
  publish(record);
  ASSERT_TRUE(eventually([&] { return receiver.is_at(1000); }));
  EXPECT_EQ(receiver.params.back(), record);
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "no constants yet"));
  EXPECT_TRUE(diagnostics.becomes(status_name(receiver.url()), "sent", "1"));
}

TEST_F(FromParams, ConstantsAreRepeatedWithTheIdOfTheParams) {
  ASSERT_NO_FATAL_FAILURE(open({receiver.url() + "?constants_period=0.1"}));
  ASSERT_NO_FATAL_FAILURE(publish(constants(1920)));
  std::uint64_t counter = 0;
  ASSERT_TRUE(eventually([&] {
    publish(params(++counter, 7));
    receiver.take();
    return receiver.constants.size() >= 3;
  }));
  for (const auto& c : receiver.constants) {
    EXPECT_EQ(c.id, 7u);
    EXPECT_EQ(c.image_width, 1920);
  }
}

TEST_F(FromParams, APresetSetsTheFormatAndOmitsAnIdThatTheReceiverCannotAccept) {
  set("preset", "unreal_trackmen");
  set("id", 5);
  ASSERT_NO_FATAL_FAILURE(open({receiver.url()}));
  publish(params(1, 7));
  ASSERT_TRUE(eventually([&] { return receiver.is_at(1); }));
  EXPECT_EQ(receiver.params.back().id, 0u);
  EXPECT_TRUE(diagnostics.reports(status_name(receiver.url()), DiagnosticStatus::OK, "id 5 is not sent"));
}

TEST_F(FromParams, OrderAndCountersOfABurstAreKept) {
  ASSERT_NO_FATAL_FAILURE(open({receiver.url()}));
  for (std::uint64_t counter = 1; counter <= 80; ++counter) publish(params(counter));
  ASSERT_TRUE(eventually([&] { return receiver.is_at(80); }));
  ASSERT_EQ(receiver.params.size(), 80u);
  for (std::size_t i = 0; i < 80; ++i) EXPECT_EQ(receiver.params[i].counter, i + 1);
}

TEST_F(FromParams, InvalidCamerasAreNotSent) {
  ASSERT_NO_FATAL_FAILURE(open({receiver.url()}));
  auto bad = params(1);
  bad.k1 = std::nan("");
  publish(bad);
  EXPECT_TRUE(diagnostics.becomes(status_name(receiver.url()), "dropped", "1"));
  publish(params(2));
  ASSERT_TRUE(eventually([&] { return receiver.is_at(2); }));
  EXPECT_EQ(receiver.params.size(), 1u);
}

TEST_F(FromParams, ARemovedSegmentIsRecreatedWithItsConstants) {
  FreeSlot slot;
  const std::string shm = "shm:" + std::to_string(slot.number());
  ASSERT_NO_FATAL_FAILURE(open({shm, receiver.url()}));
  ASSERT_NO_FATAL_FAILURE(publish(constants(1920)));
  publish(params(1));
  ASSERT_TRUE(eventually([&] { return receiver.is_at(1); }));
  slot.remove();
  std::uint64_t counter = 1;
  ASSERT_TRUE(eventually([&] {
    publish(params(++counter));
    receiver.take();
    return slot.segment() >= 0;
  }));
  const auto source = endpoints::open_source(shm, 50);
  transport::Reception reception;
  bool has_constants = false, has_params = false;
  ASSERT_TRUE(eventually([&] {
    publish(params(++counter));
    receiver.take();
    if (source->receive(reception, std::chrono::milliseconds(50)) != transport::Event::sample) return false;
    const auto& record = reception.sample.record;
    if (const auto* c = std::get_if<wire::CameraConstants>(&record)) has_constants = c->image_width == 1920;
    if (const auto* p = std::get_if<wire::CameraParams>(&record)) has_params = p->counter > 1;
    return has_constants && has_params;
  }));
  ASSERT_TRUE(eventually([&] { return receiver.is_at(counter); }));
  EXPECT_EQ(receiver.params.size(), counter) << "none is missing";
}

TEST_F(FromParams, AMessageIsDelayedAccordingToItsStamp) {
  set("delay", 0.05);
  ASSERT_NO_FATAL_FAILURE(open({receiver.url(), receiver.url() + "?delay=0&id=9"}));
  std::uint64_t counter = 0;
  std::vector<wire::CameraParams> delayed, at_once;
  auto next = std::chrono::steady_clock::now();
  ASSERT_TRUE(eventually([&] {
    if (std::chrono::steady_clock::now() >= next) {
      next += std::chrono::milliseconds(20);
      auto record = params(++counter, 7);
      record.euler.x = static_cast<double>(counter);
      publish(record);
    }
    receiver.take();
    for (const auto& one : receiver.params) (one.id == 9 ? at_once : delayed).push_back(one);
    receiver.params.clear();
    return delayed.size() >= 30 && at_once.size() >= 30;
  }));
  EXPECT_EQ(at_once.front().euler.x, 1) << "this one is sent at once";
  EXPECT_EQ(at_once.front().counter, 1u);
  for (std::size_t i = 1; i < delayed.size(); ++i) {
    EXPECT_EQ(delayed[i].counter, delayed[i - 1].counter + 1);
    EXPECT_GT(delayed[i].euler.x, delayed[i - 1].euler.x);
  }
}

/// As a process: the file size limit that replaces a full disk affects all files of a process.
class OnAFullDisk : public NodeProcessTest {
 protected:
  OnAFullDisk() : NodeProcessTest(ROS_TO_TRK) {}

  const TemporaryDirectory folder;
  Receiver receiver;
};

TEST_F(OnAFullDisk, AFailedSinkDoesNotAffectOthersAndRecovers) {
  // The file size limit that replaces a full disk must not end the node.
  ::signal(SIGXFSZ, SIG_IGN);
  const std::string file = "file:" + folder / "take.trk";
  set("sinks", std::vector<std::string>{file, receiver.url()});
  set("queue_size", 10000);
  const ParamsPublisher publisher(name_space);
  ASSERT_TRUE(starts());
  ASSERT_TRUE(eventually([&] { return publisher.has_subscribers(); }));
  publisher.publish(constants());
  ASSERT_TRUE(diagnostics.becomes(status_name(), "constants known", "received"));
  std::uint64_t counter = 0;
  const auto send_until = [&](const std::function<bool()>& met) {
    return eventually([&] {
      publisher.publish(params(++counter));
      receiver.take();
      return met();
    });
  };
  const auto sent_to_file = [&] { return std::stoul("0" + diagnostics.value(status_name(file), "sent")); };
  // More than the size of the node's log, which the limit also affects.
  ASSERT_TRUE(send_until([&] { return sent_to_file() > 600; }));
  const rlimit full{20'000, RLIM_INFINITY};
  ASSERT_EQ(::prlimit(node->pid(), RLIMIT_FSIZE, &full, nullptr), 0);
  ASSERT_TRUE(send_until([&] { return std::stoul("0" + diagnostics.value(status_name(file), "errors")) > 10; }));
  ASSERT_TRUE(send_until([&] {
    const auto* status = diagnostics.find(status_name(file));
    return status != nullptr && status->level == DiagnosticStatus::ERROR;
  }));
  EXPECT_THAT(diagnostics.find(status_name(file))->message, HasSubstr("nothing is sent: the system refused"));
  EXPECT_EQ(diagnostics.value(status_name(receiver.url()), "errors"), "0");

  const rlimit room{RLIM_INFINITY, RLIM_INFINITY};
  ASSERT_EQ(::prlimit(node->pid(), RLIMIT_FSIZE, &room, nullptr), 0);
  ASSERT_TRUE(send_until([&] {
    const auto* status = diagnostics.find(status_name(file));
    return status->level == DiagnosticStatus::OK;
  }));
  ASSERT_TRUE(eventually([&] { return receiver.is_at(counter); }));
  EXPECT_EQ(receiver.params.size(), counter) << "none is missing";
  interrupted();
  const auto take = file::read_take(folder / "take.trk");
  EXPECT_EQ(take.params.back().counter, counter);
  EXPECT_LT(take.params.size(), counter);
}

}  // namespace trk_bridge::test::outgoing_test
