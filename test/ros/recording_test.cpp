// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A camera recorded and played by the launch files, and conversions of the recordings by trk bag.
#include <algorithm>
#include <filesystem>

#include <rosgraph_msgs/Clock.h>

#include "file/take_writer.h"
#include "fixture.h"
#include "program.h"
#include "record_bits.h"
#include "roslaunch.h"
#include "temporary_directory.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::test::recording_test {

/// Whether `part` is contained in `whole` without a gap.
::testing::AssertionResult is_run_of(const std::vector<wire::CameraParams>& part,
                                     const std::vector<wire::CameraParams>& whole) {
  const auto equal = [](const auto& a, const auto& b) { return bits(a) == bits(b); };
  const auto found = std::search(whole.begin(), whole.end(), part.begin(), part.end(), equal);
  if (found != whole.end()) return ::testing::AssertionSuccess() << "from field " << found - whole.begin();
  return ::testing::AssertionFailure() << part.size() << " fields are not contiguous in the " << whole.size();
}

class Recording : public TrkToRosTest {
 protected:
  ::testing::AssertionResult trk_bag(const std::string& from, const std::string& to,
                                     const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{TRK_TOOL, "bag", from, to};
    words.insert(words.end(), options.begin(), options.end());
    Program trk(words);
    const std::string output = trk.rest_of_err();
    if (trk.wait() != 0) return ::testing::AssertionFailure() << output;
    return ::testing::AssertionSuccess() << output;
  }

  TemporaryDirectory directory;
};

TEST_F(Recording, OfARunningNodeIsTheSentTake) {
  set("source", any_udp_port);
  set("format", "as_received");
  ASSERT_TRUE(starts());
  const auto take = file::read_take(data_path("field/takes/euler.trk"));
  const std::string bag = directory / "recorded.bag";
  Roslaunch recorder("record.launch", {"camera:=" + camera, "bag:=" + bag});
  Tracker tracker(port());
  std::size_t sent = 0;
  const auto recorded = [&] {
    std::error_code none_yet;
    const auto size = std::filesystem::file_size(bag + ".active", none_yet);
    return !none_yet && size > 50'000;
  };
  ASSERT_TRUE(eventually([&] {
    tracker.send(take.constants);
    tracker.send(take.params[sent++ % take.params.size()]);
    return recorded();
  }));
  recorder.end();
  ASSERT_TRUE(trk_bag(bag, directory / "back.trk", {"--field-rate", "50"}));
  const auto back = file::read_take(directory / "back.trk");
  EXPECT_GE(back.params.size(), 20u);
  EXPECT_EQ(bits(back.constants), bits(take.constants));
  EXPECT_TRUE(is_run_of(back.params, take.params));
}

TEST_F(Recording, PlayedBackFeedsRosToTrk) {
  const auto whole = file::read_take(data_path("field/takes/euler.trk"));
  const std::string short_take = directory / "short.trk";
  {
    file::TakeWriter writer(short_take, whole.time_code, /*overwrite=*/false);
    ASSERT_TRUE(writer.write(whole.constants));
    for (std::size_t i = 0; i < 200; ++i) ASSERT_TRUE(writer.write(whole.params[i]));
    ASSERT_TRUE(writer.close());
  }
  const std::string bag = directory / "short.bag";
  ASSERT_TRUE(trk_bag(short_take, bag, {"--camera", camera}));
  const std::string sent = directory / "sent.trk";
  Roslaunch("playback.launch", {"file:=" + bag, "camera:=" + camera, "sinks:=['file:" + sent + "']", "delay:=5"})
      .wait();
  const auto back = file::read_take(sent);
  EXPECT_GE(back.params.size(), 100u);
  EXPECT_TRUE(is_run_of(back.params, whole.params));
  EXPECT_FALSE(::ros::param::has("/use_sim_time")) << "remains when the bag has ended";
}

TEST_F(Recording, PlayedBackAndInterruptedLeavesNoSimulatedTimeBehind) {
  const std::string bag = directory / "take.bag";
  ASSERT_TRUE(trk_bag(data_path("field/takes/euler.trk"), bag, {"--camera", camera}));
  Recorder<rosgraph_msgs::Clock> clock("/clock");
  Roslaunch playback("playback.launch", {"file:=" + bag, "camera:=" + camera, "loop:=true"});
  ASSERT_TRUE(eventually([&] { return clock.messages.size() > 100; }));
  EXPECT_TRUE(::ros::param::has("/use_sim_time"));
  playback.end();
  EXPECT_FALSE(::ros::param::has("/use_sim_time"));
}

}  // namespace trk_bridge::test::recording_test
