// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/outlet.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "controlled_sink.h"
#include "deadline.h"
#include "error_of.h"
#include "temporary_directory.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "udp.h"

namespace trk_bridge::bridge::outlet_test {

using test::constants;
using test::endpoint_of;
using test::params;
using test::SinkControl;
using transport::Blocking;

/// Opens the sinks when a test ends, also by a failure, because the destructor of an outlet waits for its sink. Declare
/// it after the outlets, so that it is destroyed before them.
class OpensAtEnd {
 public:
  explicit OpensAtEnd(std::vector<SinkControl*> controls) : controls_(std::move(controls)) {}
  ~OpensAtEnd() {
    for (auto* control : controls_) control->open();
  }
  OpensAtEnd(const OpensAtEnd&) = delete;
  OpensAtEnd& operator=(const OpensAtEnd&) = delete;

 private:
  const std::vector<SinkControl*> controls_;
};

/// Uses an outlet while its sink blocks in the first write: the sink has one record, the others are queued.
template <typename Use>
void with_blocked(SinkControl& control, Outlet& outlet, const Use& use) {
  outlet.write(constants());
  ASSERT_TRUE(control.is_blocking());
  use();
}

TEST(Outlet, ASinkThatNeverBlocksIsWrittenInTheCallersThread) {
  SinkControl control;
  control.open();
  Outlet outlet(endpoint_of(control), {});
  outlet.write(params(1));
  EXPECT_EQ(control.params().size(), 1u);
  EXPECT_FALSE(outlet.queue());
  EXPECT_EQ(outlet.statistics().sent.params, 1u);
}

TEST(Outlet, ABlockingSinkDoesNotSlowDownOthers) {
  constexpr std::uint64_t sets = 5000;
  SinkControl live, segment, take;
  live.open();
  Outlet to_live(endpoint_of(live), {});
  Outlet to_segment(endpoint_of(segment, Blocking::attaching), {});
  Outlet to_take(endpoint_of(take, Blocking::storage), {});
  const OpensAtEnd guard({&segment, &take});
  for (std::uint64_t counter = 1; counter <= sets; ++counter) {
    for (auto* outlet : {&to_segment, &to_take, &to_live}) outlet->write(params(counter));
    ASSERT_EQ(live.count(), counter) << "at once, although the others wait";
  }
  EXPECT_EQ(segment.count() + take.count(), 0u);
  segment.open();
  take.open();
  EXPECT_TRUE(to_segment.close() && to_take.close());
  const auto taken = take.params();
  EXPECT_EQ(taken.size(), sets) << "no record of a recording is lost while the queue has room";
  for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i].counter, i + 1);
}

TEST(Outlet, AttachingDropsTheOldestSetsAndCountsThem) {
  constexpr std::uint64_t sets = 500;
  SinkControl control;
  std::uint64_t losses = 0;
  OutletOptions options;
  options.listener = [&losses](const Loss& loss) {
    losses += std::get<OutletReason>(loss.cause) == OutletReason::outdated;
  };
  Outlet outlet(endpoint_of(control, Blocking::attaching), options);
  const OpensAtEnd guard({&control});
  with_blocked(control, outlet, [&] {
    outlet.write(constants(1920));
    for (std::uint64_t counter = 1; counter <= sets; ++counter) outlet.write(params(counter));
  });
  const auto queue = outlet.queue();
  ASSERT_TRUE(queue);
  EXPECT_GT(queue->drops, 0u);
  EXPECT_EQ(queue->drops, losses);
  EXPECT_FALSE(queue->failed);
  const auto queued = queue->queued;
  control.open();
  ASSERT_TRUE(outlet.close());
  EXPECT_EQ(control.constants(), (std::vector<wire::CameraConstants>{constants(), constants(1920)})) << "state is kept";
  const auto written = control.params();
  ASSERT_EQ(written.size(), sets - losses);
  EXPECT_EQ(written.size() + 1, queued);
  for (std::size_t i = 0; i < written.size(); ++i) EXPECT_EQ(written[i].counter, losses + i + 1);
}

TEST(Outlet, ConstantsOfTooManyIdsThatTheQueueCannotKeepAreReported) {
  SinkControl control;
  std::vector<OutletReason> reasons;
  OutletOptions options;
  options.listener = [&reasons](const Loss& loss) { reasons.push_back(std::get<OutletReason>(loss.cause)); };
  Outlet outlet(endpoint_of(control, Blocking::attaching), options);
  const OpensAtEnd guard({&control});
  with_blocked(control, outlet, [&] {
    std::uint32_t id = 0;
    while (outlet.queue()->drops == 0) {
      ASSERT_LT(id, 10'000u);
      outlet.write(constants(720, ++id));
    }
    EXPECT_GT(id, OutletWriter::most_ids);
  });
  EXPECT_THAT(reasons, testing::ElementsAre(OutletReason::too_many_ids));
}

TEST(Outlet, ARecordingThatCannotKeepUpEndsAndKeepsItsRecords) {
  SinkControl control;
  std::uint64_t losses = 0;
  OutletOptions options;
  options.listener = [&losses](const Loss& loss) {
    losses += std::get<OutletReason>(loss.cause) == OutletReason::too_slow;
  };
  Outlet outlet(endpoint_of(control, Blocking::storage), options);
  const OpensAtEnd guard({&control});
  std::uint64_t counter = 0;
  with_blocked(control, outlet, [&] {
    while (!outlet.queue()->failed) {
      ASSERT_LT(counter, 1'000'000u);
      outlet.write(params(++counter));
    }
  });
  EXPECT_GT(counter, 9000u) << "three minutes of 50 Hz";
  control.open();
  ASSERT_TRUE(control.has_written(counter));
  outlet.write(params(++counter));
  ASSERT_TRUE(outlet.close());
  EXPECT_TRUE(control.is_closed());
  const auto written = control.params();
  EXPECT_EQ(written.size(), counter - 2) << "all before the one that did not fit, and none after it";
  for (std::size_t i = 0; i < written.size(); ++i) EXPECT_EQ(written[i].counter, i + 1);
  EXPECT_EQ(outlet.queue()->drops, 2u);
  EXPECT_EQ(losses, 2u);
}

TEST(Outlet, IfTheCallerCanWaitNothingIsLost) {
  constexpr std::uint64_t sets = 15'000;
  for (const auto blocking : {Blocking::attaching, Blocking::storage}) {
    SinkControl control;
    control.open();
    OutletOptions options;
    options.may_wait = [] { return true; };
    options.listener = [](const Loss&) { FAIL(); };
    Outlet outlet(endpoint_of(control, blocking), options);
    for (std::uint64_t counter = 1; counter <= sets; ++counter) outlet.write(params(counter));
    ASSERT_TRUE(outlet.close());
    EXPECT_EQ(control.params().size(), sets);
    EXPECT_EQ(outlet.queue()->drops, 0u);
  }
}

TEST(Outlet, ClosingWritesWhatIsQueuedThenEndsTheSink) {
  SinkControl control;
  Outlet outlet(endpoint_of(control, Blocking::storage), {});
  const OpensAtEnd guard({&control});
  with_blocked(control, outlet, [&] {
    for (std::uint64_t counter = 1; counter <= 100; ++counter) outlet.write(params(counter));
  });
  EXPECT_FALSE(control.is_closed());
  control.open();
  EXPECT_TRUE(outlet.close());
  EXPECT_EQ(control.params().size(), 100u);
  EXPECT_TRUE(control.is_closed());
  EXPECT_TRUE(outlet.close()) << "again";
  outlet.write(params(101));
  EXPECT_EQ(control.params().size(), 100u);
  EXPECT_EQ(outlet.statistics().last_fault.reason, transport::SinkReason::closed);
}

TEST(Outlet, DestroyingItClosesItLikewise) {
  SinkControl control;
  {
    Outlet outlet(endpoint_of(control, Blocking::storage), {});
    const OpensAtEnd guard({&control});
    with_blocked(control, outlet, [&] { outlet.write(params(1)); });
  }
  EXPECT_EQ(control.params().size(), 1u);
  EXPECT_TRUE(control.is_closed());
}

TEST(Outlet, IsOpenedInItsOwnThreadAndNothingIsLostMeanwhile) {
  SinkControl control;
  control.open();
  control.block_opening();
  Outlet outlet(endpoint_of(control, Blocking::storage), {});
  ASSERT_TRUE(control.was_tried(1));
  outlet.write(constants());
  for (std::uint64_t counter = 1; counter <= 100; ++counter) outlet.write(params(counter));
  const auto opening = outlet.state();
  EXPECT_FALSE(opening.is_open);
  EXPECT_NE(opening.busy_since, 0);
  EXPECT_EQ(outlet.queue()->queued, 101u);
  control.permit_opening();
  ASSERT_TRUE(control.has_written(101));
  ASSERT_TRUE(outlet.close());
  EXPECT_TRUE(outlet.state().is_open);
  EXPECT_EQ(outlet.state().busy_since, 0);
}

TEST(Outlet, OpeningIsRetried) {
  SinkControl control;
  control.open();
  control.set_opening_error("take.trk: it exists");
  Outlet outlet(endpoint_of(control, Blocking::storage), {});
  ASSERT_TRUE(control.was_tried(2)) << "although nothing is written";
  EXPECT_EQ(outlet.state().cannot_open, "take.trk: it exists");
  EXPECT_FALSE(outlet.state().is_open);
  control.set_opening_error("");
  EXPECT_TRUE(test::becomes_true([&] { return outlet.state().is_open; }));
  EXPECT_EQ(outlet.state().cannot_open, "");
}

TEST(Outlet, RefusedWritesAreCountedAndOpeningIsNotRetriedForEveryRecord) {
  SinkControl control;
  control.open();
  control.set_opening_error("slot 7: unknown");
  control.set_fault(transport::SinkFault{transport::SinkReason::no_segment});
  Outlet outlet(endpoint_of(control, Blocking::attaching), {});
  ASSERT_TRUE(control.was_tried(1));
  for (std::uint64_t counter = 1; counter <= 50; ++counter) outlet.write(params(counter));
  ASSERT_TRUE(outlet.close());
  EXPECT_EQ(outlet.statistics().failed_sets, 50u);
  EXPECT_EQ(outlet.state().cannot_open, "slot 7: unknown") << "which is more precise than the fault of a write";
}

TEST(Outlet, WithMustOpenTheReasonIsThrown) {
  SinkControl control;
  control.set_opening_error("take.trk: it exists");
  OutletOptions options;
  options.must_open = true;
  EXPECT_EQ(test::error_of<transport::TransportError>(
                [&] { const Outlet outlet(endpoint_of(control, Blocking::storage), options); }),
            "take.trk: it exists");
}

/// With a sink that no longer responds.
class StuckOutlet : public testing::Test {
 protected:
  ~StuckOutlet() override {
    control->open();
    control->permit_opening();
    EXPECT_TRUE(control->closes()) << "an abandoned sink continues";
  }
  static std::chrono::nanoseconds time_of(const std::function<void()>& act) {
    const auto begin = std::chrono::steady_clock::now();
    act();
    return std::chrono::steady_clock::now() - begin;
  }

  const std::shared_ptr<SinkControl> control = std::make_shared<SinkControl>();
};

TEST_F(StuckOutlet, IsAbandonedAndReportsWhatIsMissing) {
  std::atomic<int> losses{0};
  {
    OutletOptions options;
    options.listener = [&losses](const Loss&) { ++losses; };
    Outlet outlet(endpoint_of(control, Blocking::storage), options);
    outlet.write(constants());
    ASSERT_TRUE(control->is_blocking());
    for (std::uint64_t counter = 1; counter <= 7; ++counter) outlet.write(params(counter));
    const auto closed = outlet.close();
    ASSERT_FALSE(closed);
    EXPECT_EQ(closed.error().reason, transport::SinkReason::no_answer);
    EXPECT_EQ(outlet.unwritten(), 8u);
    outlet.write(params(8));
    EXPECT_TRUE(outlet.close()) << "again";
    EXPECT_EQ(losses, 0) << "the listener is no longer called";
  }
  control->set_fault(transport::SinkFault{transport::SinkReason::system, {}, ENOSPC});
  control->open();
  ASSERT_TRUE(control->closes());
  EXPECT_EQ(losses, 0) << "the listener is no longer called";
}

TEST_F(StuckOutlet, ContinuesInTheBackgroundWhenItCan) {
  {
    Outlet outlet(endpoint_of(control, Blocking::storage), {});
    outlet.write(constants());
    ASSERT_TRUE(control->is_blocking());
    for (std::uint64_t counter = 1; counter <= 7; ++counter) outlet.write(params(counter));
  }
  EXPECT_EQ(control->count(), 0u);
  control->open();
  ASSERT_TRUE(control->closes());
  EXPECT_EQ(control->count(), 8u);
}

TEST_F(StuckOutlet, ASinkThatIsBeingOpenedIsAbandonedLikewise) {
  control->block_opening();
  Outlet outlet(endpoint_of(control, Blocking::storage), {});
  ASSERT_TRUE(control->was_tried(1));
  outlet.write(params(1));
  EXPECT_EQ(outlet.close().error().reason, transport::SinkReason::no_answer);
  EXPECT_EQ(outlet.unwritten(), 1u);
}

TEST_F(StuckOutlet, SeveralSinksAreWaitedForAtTheSameTime) {
  constexpr int count = 6;
  std::vector<std::shared_ptr<SinkControl>> controls;
  std::vector<std::unique_ptr<Outlet>> outlets;
  for (int i = 0; i < count; ++i) {
    controls.push_back(std::make_shared<SinkControl>());
    outlets.push_back(std::make_unique<Outlet>(endpoint_of(controls.back(), Blocking::storage), OutletOptions{}));
    outlets.back()->write(params(1));
    ASSERT_TRUE(controls.back()->is_blocking());
  }
  EXPECT_LT(time_of([&] {
              for (const auto& outlet : outlets) outlet->finish();
              for (const auto& outlet : outlets) EXPECT_FALSE(outlet->close());
            }),
            (count - 1) * Outlet::patience);
  for (const auto& one : controls) {
    one->open();
    EXPECT_TRUE(one->closes());
  }
  control->close();
}

TEST_F(StuckOutlet, ASlowSinkGetsTheTimeItNeeds) {
  control->open();
  control->set_delay(Outlet::patience / 5);
  Outlet outlet(endpoint_of(control, Blocking::storage), {});
  for (std::uint64_t counter = 1; counter <= 15; ++counter) outlet.write(params(counter));
  EXPECT_TRUE(outlet.close());
  EXPECT_EQ(control->count(), 15u);
}

TEST_F(StuckOutlet, ASegmentIsNotWaitedForAsLong) {
  control->open();
  control->set_delay(Outlet::patience / 5);
  Outlet outlet(endpoint_of(control, Blocking::attaching), {});
  for (std::uint64_t counter = 1; counter <= 60; ++counter) outlet.write(params(counter));
  EXPECT_FALSE(outlet.close());
  EXPECT_LT(control->count(), 60u);
  control->set_delay(std::chrono::milliseconds(0));
}

TEST_F(StuckOutlet, WithMayWaitASinkIsWaitedForAsLongAsAllowed) {
  std::atomic<bool> may_wait{true};
  OutletOptions options;
  options.may_wait = [&may_wait] { return may_wait.load(); };
  Outlet outlet(endpoint_of(control, Blocking::storage), options);
  outlet.write(params(1));
  ASSERT_TRUE(control->is_blocking());
  auto closed = std::async(std::launch::async, [&outlet] { return outlet.close(); });
  EXPECT_EQ(closed.wait_for(3 * Outlet::patience), std::future_status::timeout);
  may_wait = false;
  ASSERT_EQ(closed.wait_for(test::deadline), std::future_status::ready);
  EXPECT_FALSE(closed.get());
}

TEST(Outlet, TheTimeOfAFieldIsPassedOn) {
  const test::TemporaryDirectory directory;
  Outlet outlet(endpoints::parse_sink("file:" + (directory / "%Y.trk")).value(), {});
  outlet.write(constants());
  outlet.write(params(1), 1'795'342'830'500'000'000);
  ASSERT_TRUE(outlet.close());
  EXPECT_THAT(outlet.name(), testing::HasSubstr("2026.trk"));
}

TEST(Outlet, CloseReturnsTheResultOfTheSink) {
  const test::TemporaryDirectory directory;
  Outlet outlet(endpoints::parse_sink("file:" + (directory / "take.trk")).value(), {});
  outlet.write(params(1));
  const auto closed = outlet.close();
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().reason, transport::SinkReason::no_constants);
}

TEST(Outlet, AFaultInItsOwnThreadIsReportedAndCounted) {
  SinkControl control;
  control.open();
  control.set_fault(transport::SinkFault{transport::SinkReason::system, {}, ENOSPC});
  std::vector<Loss> losses;
  OutletOptions options;
  options.listener = [&losses](const Loss& loss) { losses.push_back(loss); };
  Outlet outlet(endpoint_of(control, Blocking::storage), options);
  outlet.write(params(1, 7));
  outlet.write(params(2, 7));
  ASSERT_TRUE(outlet.close());
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(losses[0].id, 7u);
  EXPECT_EQ(std::get<transport::SinkFault>(losses[0].cause).error_number, ENOSPC);
  const auto statistics = outlet.statistics();
  EXPECT_EQ(statistics.failed_sets, 2u);
  EXPECT_TRUE(statistics.fails);
  EXPECT_EQ(statistics.sent.errors, 2u);
}

TEST(Outlet, OptionsThatTheEndpointDoesNotSetHaveDefaults) {
  SinkControl control;
  transport::SinkForm given;
  given.format = wire::euler | wire::field_of_view;
  OutletOptions options;
  options.defaults.format = wire::euler;
  options.defaults.sends_id = false;
  options.defaults.id = 5;
  const Outlet outlet(endpoint_of(control, Blocking::never, given), options);
  EXPECT_EQ(outlet.form().format, given.format);
  EXPECT_TRUE(outlet.form().sends_id) << "it belongs to the format";
  EXPECT_EQ(outlet.form().id, 5u);
  EXPECT_EQ(outlet.url(), "test:control");
  EXPECT_EQ(outlet.name(), "control");
}

}  // namespace trk_bridge::bridge::outlet_test
