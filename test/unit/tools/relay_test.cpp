// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tools/relay.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/clock.h"
#include "controlled_sink.h"
#include "memory_feed.h"
#include "same_camera.h"
#include "temporary_directory.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/wire/format.h"
#include "udp.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::tools::relay_test {

using testing::HasSubstr;
using transport::Event;

class RelayTest : public testing::Test {
 protected:
  RelayTest() { control.open(); }

  void add(const transport::SinkEndpoint& endpoint) { to.push_back(endpoint); }
  void add_sink(const transport::SinkForm& form = {}) {
    add(test::endpoint_of(control, transport::Blocking::never, form));
  }
  void add_file(const std::string& path) { add(endpoints::parse_sink("file:" + path).value()); }
  cli::ExitCode run(const transport::SinkForm& defaults = {}, bool source_can_wait = false) {
    feed.put(Event::ended);
    FanOut sinks(err, source_can_wait ? [] { return true; } : std::function<bool()>());
    for (const auto& endpoint : to) sinks.add(endpoint, defaults);
    return relay(*feed.source(), sinks);
  }

  test::MemoryFeed feed;
  test::SinkControl control;
  std::vector<transport::SinkEndpoint> to;
  std::ostringstream err;
};

transport::SinkForm form_of(std::uint32_t format) {
  transport::SinkForm form;
  form.format = format;
  return form;
}

TEST_F(RelayTest, EveryWorkedCaseBecomesTheCanonicalCameraInEuler) {
  const auto cases = test::read_jsonl("camera_cases.jsonl");
  for (const auto& one : cases) {
    auto constants = test::constants_of(one["constants"]);
    feed.put(constants);
    feed.put(test::case_params_of(one["params"]));
  }
  add_sink();
  EXPECT_EQ(run(form_of(wire::euler)), cli::exit_good) << err.str();
  const auto sent = control.params();
  ASSERT_EQ(sent.size(), cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& params = sent[i];
    const auto& expected = cases[i]["expect"];
    const auto near = [&](double found, double wanted) {
      EXPECT_NEAR(found, wanted, 1e-9 * std::max(1.0, std::abs(wanted))) << "case " << i;
    };
    EXPECT_EQ(params.format, wire::euler);
    EXPECT_EQ(params.counter, cases[i]["params"]["counter"].GetUint64());
    near(params.euler.x, expected["euler"]["x"].GetDouble());
    near(params.euler.y, expected["euler"]["y"].GetDouble());
    near(params.euler.z, expected["euler"]["z"].GetDouble());
    EXPECT_LT(test::degrees_apart(params.euler.pan, expected["euler"]["pan"].GetDouble()), 1e-7) << "case " << i;
    EXPECT_LT(test::degrees_apart(params.euler.tilt, expected["euler"]["tilt"].GetDouble()), 1e-7) << "case " << i;
    EXPECT_LT(test::degrees_apart(params.euler.roll, expected["euler"]["roll"].GetDouble()), 1e-7) << "case " << i;
    near(params.fov, expected["image_distance_mm"].GetDouble());
    near(params.center_x, expected["center_shift_mm"][0].GetDouble());
    near(params.center_y, expected["center_shift_mm"][1].GetDouble());
    near(params.k1, cases[i]["params"]["k1"].GetDouble());
    near(params.focdist, cases[i]["params"]["focdist"].GetDouble());
  }
}

TEST_F(RelayTest, WithoutOptionsRecordsAreNotChanged) {
  std::vector<wire::Record> sent;
  for (const auto& line : test::read_jsonl("field/identified_lp64/params.jsonl")) {
    sent.emplace_back(test::params_of(line["fields"]));
  }
  sent.emplace_back(test::constants(720, 3));
  for (const auto& record : sent) feed.put(record);
  add_sink();
  EXPECT_EQ(run(), cli::exit_good);
  const auto records = control.records();
  EXPECT_EQ(records, sent);
  EXPECT_TRUE(control.is_closed());
  EXPECT_THAT(err.str(), HasSubstr("received " + std::to_string(sent.size())));
}

TEST_F(RelayTest, RecordsWithoutALensAreRefusedWithTheReason) {
  feed.put(test::params(1, 3));
  feed.put_without_lens(test::params(2, 3));
  feed.put_without_lens(test::params(3, 3));
  add_sink();
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_EQ(control.params().size(), 1u);
  EXPECT_THAT(err.str(),
              HasSubstr("parameters from 127.0.0.1:5000 cannot be passed on: the records have no lens: set a lens "
                        "table of the source (lens=FILE) (reported once)"));
  EXPECT_THAT(err.str(), HasSubstr("not passed on: 2 parameters: the records have no lens"));
}

TEST_F(RelayTest, ALensOutsideItsTableIsReported) {
  feed.put_without_lens(test::params(2, 3), "the lens encoders are beyond the lens table");
  add_sink();
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_THAT(err.str(), HasSubstr("the records have no lens: the lens encoders are beyond the lens table"));
}

TEST_F(RelayTest, AnotherIdReplacesTheReceivedOne) {
  feed.put(test::constants(720, 3));
  feed.put(test::params(1, 3));
  add_sink();
  transport::SinkForm form;
  form.id = 9;
  EXPECT_EQ(run(form), cli::exit_good);
  const auto records = control.records();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(std::get<wire::CameraConstants>(records[0]), test::constants(720, 9));
  EXPECT_EQ(std::get<wire::CameraParams>(records[1]), test::params(1, 9));
}

TEST_F(RelayTest, ConstantsAreKeptById) {
  // The same angle on chips of two widths is two image distances.
  auto wide = test::constants(720, 1), narrow = test::constants(720, 2);
  narrow.chip_width = narrow.fake_chip_width = wide.chip_width / 2;
  auto params = test::params(1, 1);
  params.format |= wire::field_of_view;
  params.fov = 90;
  feed.put(wide);
  feed.put(narrow);
  feed.put(params);
  params.id = 2;
  feed.put(params);
  add_sink();
  EXPECT_EQ(run(form_of(wire::euler)), cli::exit_good) << err.str();
  const auto records = control.records();
  ASSERT_EQ(records.size(), 4u);
  EXPECT_NEAR(std::get<wire::CameraParams>(records[2]).fov, 4.4, 1e-12);
  EXPECT_NEAR(std::get<wire::CameraParams>(records[3]).fov, 2.2, 1e-12);
}

TEST_F(RelayTest, TheFakeChipFitsTheSentFormat) {
  auto constants = test::constants(720);
  constants.blank_left = constants.blank_right = 10;
  constants.fake_chip_width = constants.fake_chip_height = 0;
  feed.put(constants);
  add_sink();
  EXPECT_EQ(run(form_of(wire::euler | wire::ignore_blank | wire::keep_aspect)), cli::exit_good);
  const auto records = control.records();
  ASSERT_EQ(records.size(), 1u);
  const auto& sent = std::get<wire::CameraConstants>(records[0]);
  EXPECT_NEAR(sent.fake_chip_width, 8.8 * 720 / 700, 1e-12);
  EXPECT_NEAR(sent.fake_chip_height, 6.6 * 720 / 700, 1e-12);
}

TEST_F(RelayTest, RecordsThatNeedConstantsAreRefusedWithoutThemReportedOnceAndCounted) {
  auto params = test::params(1);
  params.format |= wire::field_of_view;
  for (params.counter = 1; params.counter <= 3; ++params.counter) feed.put(params);
  feed.put(test::constants());
  feed.put(params);
  add_sink();
  EXPECT_EQ(run(form_of(wire::euler)), cli::exit_failed);
  const auto records = control.records();
  EXPECT_EQ(records.size(), 2u);
  EXPECT_THAT(err.str(), HasSubstr("cannot be passed on as \"euler"));
  EXPECT_THAT(err.str(), HasSubstr("not passed on: 3 records"));
  const std::string once = "(reported once)";
  EXPECT_EQ(err.str().find(once), err.str().rfind(once));
}

TEST_F(RelayTest, InvalidConstantsInvalidateEarlierOnes) {
  auto params = test::params(1);
  params.format |= wire::field_of_view;
  feed.put(test::constants(720));
  feed.put(test::constants(-1));
  feed.put(params);
  add_sink();
  EXPECT_EQ(run(form_of(wire::euler)), cli::exit_failed);
  const auto records = control.records();
  EXPECT_EQ(records.size(), 1u) << "only the first constants: the following ones are invalid";
}

TEST_F(RelayTest, ASinkThatRefusesDoesNotAffectOthers) {
  test::SinkControl torn;
  torn.open();
  torn.set_fault(transport::SinkFault{transport::SinkReason::system, {}, ENETUNREACH});
  for (const auto blocking : {transport::Blocking::never, transport::Blocking::storage}) {
    add(test::endpoint_of(torn, blocking, {}, blocking == transport::Blocking::never ? "torn wire" : "torn disk"));
  }
  add_sink();
  for (std::uint64_t counter = 1; counter <= 4; ++counter) feed.put(test::params(counter));
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_EQ(control.records().size(), 4u);
  EXPECT_TRUE(control.is_closed() && torn.is_closed());
  for (const std::string name : {"torn wire", "torn disk"}) {
    EXPECT_THAT(err.str(), HasSubstr("trk: " + name + ": the system refused: Network is unreachable (reported once)"));
    EXPECT_THAT(err.str(), HasSubstr("trk: " + name + ": 4 times"));
  }
}

TEST_F(RelayTest, EverySinkHasItsOwnForm) {
  test::SinkControl other, plain;
  other.open();
  plain.open();
  auto form = form_of(wire::euler | wire::field_of_view);
  form.id = 3;
  add(test::endpoint_of(other, transport::Blocking::never, form));
  add(test::endpoint_of(plain));
  feed.put(test::constants(720, 7));
  feed.put(test::params(1, 7));
  EXPECT_EQ(run(), cli::exit_good) << err.str();
  EXPECT_THAT(plain.records(), testing::ElementsAre(test::constants(720, 7), test::params(1, 7)));
  ASSERT_EQ(other.params().size(), 1u);
  EXPECT_EQ(other.params()[0].id, 3u);
  EXPECT_NEAR(other.params()[0].fov, 2 * std::atan(8.8 / 2 / 42) * 180 / M_PI, 1e-9);
}

/// Over sockets: x is the time at which a set was sent, in s.
TEST_F(RelayTest, ADelayedSinkGetsTheDelayedCamera) {
  const auto seconds_now = [] { return static_cast<double>(base::wall_now() % 1'000'000'000'000) / 1e9; };
  const test::PlainSocket tracker, receiver;
  const auto source = endpoints::open_source("udp://127.0.0.1:0");
  add_sink();
  add(endpoints::parse_sink("udp://127.0.0.1:" + std::to_string(receiver.port()) + "?delay=0.04").value());
  FanOut sinks(err);
  for (const auto& endpoint : to) sinks.add(endpoint, {});
  std::thread relaying([&] { EXPECT_EQ(relay(*source, sinks), cli::exit_good) << err.str(); });

  constexpr std::uint64_t sets = 100;
  std::atomic<double> last_x = 0;
  std::atomic<bool> is_over = false;
  std::thread tracking([&] {
    auto next = std::chrono::steady_clock::now();
    for (std::uint64_t counter = 1; counter <= sets; ++counter) {
      std::this_thread::sleep_until(next += std::chrono::milliseconds(20));
      auto params = test::params(counter);
      params.euler.x = seconds_now();
      last_x = params.euler.x;
      tracker.send(test::datagram(params), "127.0.0.1", test::port_of(*source));
    }
    is_over = true;
    EXPECT_TRUE(control.has_written(sets)) << "the sink without a delay waits for nothing";
    source->stop();
  });
  double least_age = 1e9, x = 0;
  std::uint64_t counter = 0;
  wire::LayoutDetector detector;
  while (!is_over || x < last_x) {
    const auto bytes = receiver.receive();
    if (!bytes) break;
    const auto record = wire::decode(*bytes, detector).value().record;
    const auto& params = std::get<wire::CameraParams>(record);
    if (counter > 0) {
      EXPECT_EQ(params.counter, counter + 1);
      EXPECT_GT(params.euler.x, x);
    }
    counter = params.counter;
    x = params.euler.x;
    const double age = seconds_now() - x;
    EXPECT_GE(age, 0.04);
    least_age = std::min(least_age, age);
  }
  tracking.join();
  relaying.join();
  EXPECT_EQ(x, last_x) << "records that were still delayed at the end were sent";
  EXPECT_GT(counter, sets / 2);
  EXPECT_LT(least_age, 0.06);
  EXPECT_THAT(err.str(), testing::ContainsRegex("margin [0-9.]+ fields, negative [0-9]+ times of [0-9]+, age 4"));
}

TEST_F(RelayTest, ATakeThatIsReadAsFastAsPossibleCannotBeDelayed) {
  transport::SinkForm form;
  form.delay = transport::Delay{1, 1, 1};
  add_sink(form);
  try {
    run({}, true);
    FAIL() << "is refused";
  } catch (const transport::TransportError& error) {
    EXPECT_THAT(error.what(), HasSubstr("read as fast as possible cannot be delayed"));
  }
}

TEST_F(RelayTest, ASlowSinkDoesNotSlowDownOthers) {
  test::SinkControl slow;
  add(test::endpoint_of(slow, transport::Blocking::storage, {}, "slow disk"));
  add_sink();
  for (std::uint64_t counter = 1; counter <= 100; ++counter) feed.put(test::params(counter));
  // Ends when the other sink has everything; that never happens if it waits.
  std::thread watch([&] {
    EXPECT_TRUE(control.has_written(100));
    EXPECT_EQ(slow.count(), 0u);
    slow.open();
  });
  EXPECT_EQ(run(), cli::exit_good) << err.str();
  watch.join();
  EXPECT_EQ(slow.count(), 100u) << "queued records are written at the end";
}

TEST_F(RelayTest, ARecordingThatCannotKeepUpIsAFailure) {
  constexpr std::uint64_t sets = 12'000;
  test::SinkControl slow;
  add(test::endpoint_of(slow, transport::Blocking::storage, {}, "slow disk"));
  add_sink();
  for (std::uint64_t counter = 1; counter <= sets; ++counter) feed.put(test::params(counter));
  std::thread watch([&] {
    EXPECT_TRUE(control.has_written(sets));
    slow.open();
  });
  EXPECT_EQ(run(), cli::exit_failed);
  watch.join();
  const std::string text = err.str(), lost = "slow disk: the recording has ended";
  EXPECT_THAT(text, HasSubstr(lost));
  EXPECT_EQ(text.find(lost), text.rfind(lost));
  EXPECT_THAT(text, HasSubstr("slow disk: not passed on: " + std::to_string(sets - slow.count()) + " records"));
}

TEST_F(RelayTest, ATakeThatIsPlayedAsFastAsPossibleLosesNothing) {
  constexpr std::uint64_t sets = 12'000;
  test::SinkControl slow;
  add(test::endpoint_of(slow, transport::Blocking::storage));
  add(test::endpoint_of(slow, transport::Blocking::attaching));
  for (std::uint64_t counter = 1; counter <= sets; ++counter) feed.put(test::params(counter));
  std::thread watch([&] {
    EXPECT_TRUE(slow.is_blocking());
    slow.open();
  });
  EXPECT_EQ(run({}, true), cli::exit_good) << err.str();
  watch.join();
  EXPECT_EQ(slow.count(), 2 * sets);
}

TEST_F(RelayTest, NothingReceivedBeforeALimitHasItsExitCode) {
  add_sink();
  FanOut sinks(err);
  for (const auto& endpoint : to) sinks.add(endpoint, {});
  const test::TemporaryDirectory folder;
  sinks.add(endpoints::parse_sink("file:" + (folder / "take.trk")).value(), {});
  EXPECT_EQ(relay(*feed.source(), sinks, 0.01), cli::exit_nothing);
  EXPECT_THAT(err.str(), testing::AllOf(HasSubstr("received 0 "), testing::Not(HasSubstr("trk: error"))));
}

TEST_F(RelayTest, ACopyOfATakeHasItsTimeCode) {
  const test::TemporaryDirectory folder;
  const std::string take = folder / "take.trk", copy = folder / "copy.trk";
  test::write_text(take,
                   "DMC01\n10:59:59;29:2\n1920 1080 14 2 12 4 27 18 27 18\n1 1 2 3 4 5 6 50 0 0 0 0 5 8 1\n"
                   "1 1 2 3 4 5 6 50 0 0 0 0 5 8 2\n");
  const auto source = endpoints::parse_source("file:" + take + "?rate=59.94&speed=0&time=now").value().open(50);
  FanOut sinks(err, [] { return true; });
  sinks.add(endpoints::parse_sink("file:" + copy).value(), {});
  EXPECT_EQ(relay(*source, sinks), cli::exit_good) << err.str();
  EXPECT_THAT(test::read_text(copy), HasSubstr("\n10:59:59;29:2\n"));
}

TEST_F(RelayTest, ReplacedSetsAreReportedAndNotAFailure) {
  constexpr std::uint64_t sets = 500;
  test::SinkControl slow;
  add(test::endpoint_of(slow, transport::Blocking::attaching, {}, "slow slot"));
  add_sink();
  for (std::uint64_t counter = 1; counter <= sets; ++counter) feed.put(test::params(counter));
  std::thread watch([&] {
    EXPECT_TRUE(control.has_written(sets));
    slow.open();
  });
  EXPECT_EQ(run(), cli::exit_good);
  watch.join();
  EXPECT_LT(slow.count(), sets);
  EXPECT_EQ(slow.params().back().counter, sets);
  EXPECT_THAT(err.str(), HasSubstr("slow slot: not passed on: " + std::to_string(sets - slow.count()) + " records"));
}

TEST_F(RelayTest, ConstantsOfTooManyIdsAreRefused) {
  for (std::uint32_t id = 0; id < 300; ++id) feed.put(test::constants(720, id));
  add_sink();
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_EQ(control.count(), 256u);
  EXPECT_THAT(err.str(), HasSubstr("constants of more than 256 ids were received; more are not accepted"));
  EXPECT_THAT(err.str(), HasSubstr("not passed on: 44 records: "));
}

TEST_F(RelayTest, AFileBeginsWhenConstantsArrive) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "take.trk";
  add_file(path);
  for (std::uint64_t counter = 1; counter <= 3; ++counter) feed.put(test::params(counter));
  feed.put(test::constants());
  feed.put(test::params(4));
  EXPECT_EQ(run(), cli::exit_good) << err.str();
  EXPECT_THAT(err.str(), HasSubstr("not written until constants arrive"));
  EXPECT_THAT(err.str(), HasSubstr("3 times"));
  const auto take = file::read_take(path);
  ASSERT_EQ(take.params.size(), 1u);
  EXPECT_EQ(take.params[0], test::params(4));
}

TEST_F(RelayTest, WithoutConstantsThereIsNoFile) {
  const test::TemporaryDirectory directory;
  add_file(directory / "take.trk");
  feed.put(test::params(1));
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_THAT(err.str(), HasSubstr("no constants were received, so nothing was written"));
}

TEST_F(RelayTest, MalformedRecordsAreReportedOncePerReason) {
  for (int i = 0; i < 5; ++i) feed.put_malformed(wire::Reason::bad_magic);
  feed.put_malformed(wire::Reason::truncated);
  add_sink();
  EXPECT_EQ(run(), cli::exit_good);
  const std::string text = err.str();
  EXPECT_EQ(text.find("bad magic"), text.rfind("bad magic: does")) << text;
  EXPECT_THAT(text, HasSubstr("malformed 6"));
}

}  // namespace trk_bridge::tools::relay_test
