#include "tools/relay.h"

#include <cerrno>
#include <cmath>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "file/take.h"
#include "memory_feed.h"
#include "temporary_directory.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/wire/format.h"
#include "udp.h"
#include "vectors.h"

namespace trk_bridge::tools {
namespace {

using testing::HasSubstr;
using transport::Event;
using transport::Written;

/// What it took, for as long as it takes anything.
class Basket final : public transport::Sink {
 public:
  struct Content {
    std::vector<wire::Record> records;
    bool closed = false;
  };
  explicit Basket(Content& content, bool refuses = false) : content_(content), refuses_(refuses) {}

  std::string name() const override { return refuses_ ? "torn basket" : "basket"; }

 private:
  Written put(const wire::CameraParams& params) override { return take(params); }
  Written put(const wire::CameraConstants& constants) override { return take(constants); }
  Written finish() override {
    content_.closed = true;
    return {};
  }
  Written take(const wire::Record& record) {
    if (refuses_) {
      transport::SinkFault fault{transport::SinkReason::system};
      fault.error_number = ENETUNREACH;
      return tl::unexpected(fault);
    }
    content_.records.push_back(record);
    return {};
  }

  Content& content_;
  bool refuses_;
};

class RelayTest : public testing::Test {
 protected:
  void add_basket() { sinks.push_back(std::make_unique<Basket>(basket)); }
  cli::ExitCode run(const RelayOptions& options = {}) {
    feed.put(Event::ended);
    return relay(*feed.source(), std::move(sinks), options, err);
  }

  test::MemoryFeed feed;
  Basket::Content basket;
  std::vector<std::unique_ptr<transport::Sink>> sinks;
  std::ostringstream err;
};

double degrees_apart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

TEST_F(RelayTest, EveryWorkedCaseBecomesTheCanonicalCameraInEuler) {
  const auto cases = test::read_jsonl("camera_cases.jsonl");
  for (const auto& one : cases) {
    auto constants = test::constants_of(one["constants"]);
    feed.put(constants);
    feed.put(test::case_params_of(one["params"]));
  }
  add_basket();
  RelayOptions options;
  options.format = wire::euler;
  EXPECT_EQ(run(options), cli::exit_good) << err.str();
  ASSERT_EQ(basket.records.size(), 2 * cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& params = std::get<wire::CameraParams>(basket.records[2 * i + 1]);
    const auto& expected = cases[i]["expect"];
    const auto near = [&](double found, double wanted) {
      EXPECT_NEAR(found, wanted, 1e-9 * std::max(1.0, std::abs(wanted))) << "case " << i;
    };
    EXPECT_EQ(params.format, wire::euler);
    EXPECT_EQ(params.counter, cases[i]["params"]["counter"].GetUint64());
    near(params.euler.x, expected["euler"]["x"].GetDouble());
    near(params.euler.y, expected["euler"]["y"].GetDouble());
    near(params.euler.z, expected["euler"]["z"].GetDouble());
    EXPECT_LT(degrees_apart(params.euler.pan, expected["euler"]["pan"].GetDouble()), 1e-7) << "case " << i;
    EXPECT_LT(degrees_apart(params.euler.tilt, expected["euler"]["tilt"].GetDouble()), 1e-7) << "case " << i;
    EXPECT_LT(degrees_apart(params.euler.roll, expected["euler"]["roll"].GetDouble()), 1e-7) << "case " << i;
    near(params.fov, expected["image_distance_mm"].GetDouble());
    near(params.center_x, expected["center_shift_mm"][0].GetDouble());
    near(params.center_y, expected["center_shift_mm"][1].GetDouble());
    near(params.k1, cases[i]["params"]["k1"].GetDouble());
    near(params.focdist, cases[i]["params"]["focdist"].GetDouble());
  }
}

TEST_F(RelayTest, WithoutOptionsEveryRecordPassesAsItCame) {
  std::vector<wire::Record> sent;
  for (const auto& line : test::read_jsonl("field/identified_lp64/params.jsonl")) {
    sent.emplace_back(test::params_of(line["fields"]));
  }
  sent.emplace_back(test::constants(720, 3));
  for (const auto& record : sent) feed.put(record);
  add_basket();
  EXPECT_EQ(run(), cli::exit_good);
  EXPECT_EQ(basket.records, sent);
  EXPECT_TRUE(basket.closed);
  EXPECT_THAT(err.str(), HasSubstr("received " + std::to_string(sent.size())));
}

TEST_F(RelayTest, AnotherIdReplacesTheOneThatCame) {
  feed.put(test::constants(720, 3));
  feed.put(test::params(1, 3));
  add_basket();
  RelayOptions options;
  options.id = 9;
  EXPECT_EQ(run(options), cli::exit_good);
  ASSERT_EQ(basket.records.size(), 2u);
  EXPECT_EQ(std::get<wire::CameraConstants>(basket.records[0]), test::constants(720, 9));
  EXPECT_EQ(std::get<wire::CameraParams>(basket.records[1]), test::params(1, 9));
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
  add_basket();
  RelayOptions options;
  options.format = wire::euler;
  EXPECT_EQ(run(options), cli::exit_good) << err.str();
  ASSERT_EQ(basket.records.size(), 4u);
  EXPECT_NEAR(std::get<wire::CameraParams>(basket.records[2]).fov, 4.4, 1e-12);
  EXPECT_NEAR(std::get<wire::CameraParams>(basket.records[3]).fov, 2.2, 1e-12);
}

TEST_F(RelayTest, TheFakeChipAgreesWithTheFormatSent) {
  auto constants = test::constants(720);
  constants.blank_left = constants.blank_right = 10;
  constants.fake_chip_width = constants.fake_chip_height = 0;
  feed.put(constants);
  add_basket();
  RelayOptions options;
  options.format = wire::euler | wire::ignore_blank | wire::keep_aspect;
  EXPECT_EQ(run(options), cli::exit_good);
  ASSERT_EQ(basket.records.size(), 1u);
  const auto& sent = std::get<wire::CameraConstants>(basket.records[0]);
  EXPECT_NEAR(sent.fake_chip_width, 8.8 * 720 / 700, 1e-12);
  EXPECT_NEAR(sent.fake_chip_height, 6.6 * 720 / 700, 1e-12);
}

TEST_F(RelayTest, WhatNeedsConstantsIsRefusedWithoutThemOnceToldAndCounted) {
  auto params = test::params(1);
  params.format |= wire::field_of_view;
  for (params.counter = 1; params.counter <= 3; ++params.counter) feed.put(params);
  feed.put(test::constants());
  feed.put(params);
  add_basket();
  RelayOptions options;
  options.format = wire::euler;
  EXPECT_EQ(run(options), cli::exit_failed);
  EXPECT_EQ(basket.records.size(), 2u);
  EXPECT_THAT(err.str(), HasSubstr("cannot be passed on as \"euler"));
  EXPECT_THAT(err.str(), HasSubstr("not passed on: 3 records"));
  const std::string told = "(told once)";
  EXPECT_EQ(err.str().find(told), err.str().rfind(told));
}

TEST_F(RelayTest, ConstantsWithoutAPictureReplaceNothingAndAreNotReexpressed) {
  auto params = test::params(1);
  params.format |= wire::field_of_view;
  feed.put(test::constants(720));
  feed.put(test::constants(-1));
  feed.put(params);
  add_basket();
  RelayOptions options;
  options.format = wire::euler;
  EXPECT_EQ(run(options), cli::exit_failed);
  EXPECT_EQ(basket.records.size(), 1u) << "the first constants only: what came after them made them invalid";
}

TEST_F(RelayTest, ASinkThatRefusesDoesNotKeepTheOthersFromIt) {
  Basket::Content none;
  sinks.push_back(std::make_unique<Basket>(none, true));
  add_basket();
  for (std::uint64_t counter = 1; counter <= 4; ++counter) feed.put(test::params(counter));
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_EQ(basket.records.size(), 4u);
  EXPECT_TRUE(basket.closed && none.closed);
  EXPECT_THAT(err.str(), HasSubstr("trk: torn basket: "));
  EXPECT_THAT(err.str(), HasSubstr("Network is unreachable"));
  EXPECT_THAT(err.str(), HasSubstr("torn basket: 4 times"));
}

TEST_F(RelayTest, AFileBeginsWhenConstantsCome) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "take.trk";
  sinks.push_back(endpoints::open_sink("file:" + path));
  for (std::uint64_t counter = 1; counter <= 3; ++counter) feed.put(test::params(counter));
  feed.put(test::constants());
  feed.put(test::params(4));
  EXPECT_EQ(run(), cli::exit_good) << err.str();
  EXPECT_THAT(err.str(), HasSubstr("left out until constants come"));
  EXPECT_THAT(err.str(), HasSubstr("3 times"));
  const auto take = file::read_take(path);
  ASSERT_EQ(take.params.size(), 1u);
  EXPECT_EQ(take.params[0], test::params(4));
}

TEST_F(RelayTest, AFileWithoutConstantsIsNone) {
  const test::TemporaryDirectory directory;
  sinks.push_back(endpoints::open_sink("file:" + (directory / "take.trk")));
  feed.put(test::params(1));
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_THAT(err.str(), HasSubstr("no constants came, so nothing was kept"));
}

TEST_F(RelayTest, MalformedRecordsAreToldOncePerReason) {
  for (int i = 0; i < 5; ++i) feed.put_malformed(wire::Reason::bad_magic);
  feed.put_malformed(wire::Reason::truncated);
  add_basket();
  EXPECT_EQ(run(), cli::exit_good);
  const std::string text = err.str();
  EXPECT_EQ(text.find("bad magic"), text.rfind("bad magic: does")) << text;
  EXPECT_THAT(text, HasSubstr("malformed 6"));
}

}  // namespace
}  // namespace trk_bridge::tools
