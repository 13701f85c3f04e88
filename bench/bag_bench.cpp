// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Converts a take to a bag and back, compared with plain loops over rosbag::Bag and rosbag::View with the same
// messages.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraParams.h>
#include <trk_bridge/TimeCode.h>
#include <unistd.h>

#include "bag/convert.h"
#include "file/take_writer.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag {
namespace {

constexpr std::int64_t fields = 50'000;

/// A take of a camera that pans, in a temporary directory.
class Takes {
 public:
  Takes() {
    std::filesystem::create_directory(directory_);
    file::TakeWriter writer(path("take.trk"), {10, 20, 30, 12, 1}, /*overwrite=*/true);
    good_ = writer.write(wire::CameraConstants{0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39}).has_value();
    for (std::int64_t i = 0; i < fields; ++i) {
      wire::CameraParams params;
      params.format = wire::euler;
      params.euler = {1.25, -2, 1.5, std::round(30'000 * std::sin(static_cast<double>(i) / 100)) / 1000, -5.125, 0};
      params.fov = 7.7;
      params.k1 = 1e-3;
      params.focdist = 2.5;
      params.counter = static_cast<std::uint64_t>(1000 + i);
      good_ = good_ && writer.write(params);
    }
    good_ = good_ && writer.close();
  }
  ~Takes() { std::filesystem::remove_all(directory_); }
  Takes(const Takes&) = delete;
  Takes& operator=(const Takes&) = delete;

  bool good() const { return good_; }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }

 private:
  const std::filesystem::path directory_ =
      std::filesystem::temp_directory_path() / ("trk_bridge_bench." + std::to_string(::getpid()));
  bool good_ = false;
};

const Takes& takes() {
  static const Takes made;
  return made;
}

void make_bag(const std::string& bag) {
  std::ostringstream err;
  cli::LongRun run(err, /*is_terminal=*/false);
  TakeToBagOptions options;
  options.overwrite = true;
  bag_of_take(takes().path("take.trk"), bag, options, run, err);
}

void end(benchmark::State& state) {
  if (!takes().good()) state.SkipWithError("no take could be written");
  state.SetItemsProcessed(state.iterations() * fields);
}

void take_to_bag(benchmark::State& state) {
  for (auto _ : state) make_bag(takes().path("take.bag"));
  end(state);
}
BENCHMARK(take_to_bag)->Name("BM_TakeToBag/ours")->Unit(benchmark::kMillisecond);

/// Writes the same four messages per field, prepared except for their stamp. It reads no take, converts nothing, and
/// does not sync the file to disk.
void messages_to_bag(benchmark::State& state) {
  make_bag(takes().path("take.bag"));
  rosbag::Bag made(takes().path("take.bag"));
  tf2_msgs::TFMessage tf;
  CameraParams params;
  sensor_msgs::CameraInfo info;
  TimeCode code;
  for (const auto& message : rosbag::View(made)) {
    if (const auto one = message.instantiate<tf2_msgs::TFMessage>()) tf = *one;
    if (const auto one = message.instantiate<CameraParams>()) params = *one;
    if (const auto one = message.instantiate<sensor_msgs::CameraInfo>()) info = *one;
    if (const auto one = message.instantiate<TimeCode>()) code = *one;
    // After the first two fields, every message has been found.
    if (params.counter > 1001) break;
  }
  for (auto _ : state) {
    rosbag::Bag bag(takes().path("bare.bag"), rosbag::bagmode::Write);
    for (std::int64_t i = 0; i < fields; ++i) {
      const ::ros::Time stamp(static_cast<std::uint32_t>(100 + i / 50),
                              static_cast<std::uint32_t>(i % 50) * 20'000'000);
      tf.transforms.front().header.stamp = params.header.stamp = info.header.stamp = code.header.stamp = stamp;
      bag.write("/tf", stamp, tf);
      bag.write("/camera/params", stamp, params);
      bag.write("/camera/camera_info", stamp, info);
      bag.write("/camera/time_code", stamp, code);
    }
    bag.close();
  }
  end(state);
}
BENCHMARK(messages_to_bag)->Name("BM_TakeToBag/peer")->Unit(benchmark::kMillisecond);

void read_bag(benchmark::State& state, Input input) {
  make_bag(takes().path("take.bag"));
  BagToTakeOptions options;
  options.overwrite = true;
  options.input = input;
  for (auto _ : state) {
    std::ostringstream err;
    cli::LongRun run(err, /*is_terminal=*/false);
    take_of_bag(takes().path("take.bag"), takes().path("back.trk"), options, run, err);
  }
  end(state);
}
void bag_to_take(benchmark::State& state) { read_bag(state, Input::params); }
BENCHMARK(bag_to_take)->Name("BM_BagToTake/ours")->Unit(benchmark::kMillisecond);
void bag_of_tf_to_take(benchmark::State& state) { read_bag(state, Input::tf); }
BENCHMARK(bag_of_tf_to_take)->Name("BM_BagOfTfToTake/ours")->Unit(benchmark::kMillisecond);

/// Reads the messages, and writes nothing.
template <typename... Messages>
void messages_of_bag(benchmark::State& state, const std::vector<std::string>& topics) {
  make_bag(takes().path("take.bag"));
  for (auto _ : state) {
    rosbag::Bag bag(takes().path("take.bag"));
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery(topics))) {
      (benchmark::DoNotOptimize(message.instantiate<Messages>()), ...);
    }
  }
  end(state);
}
void params_of_bag(benchmark::State& state) { messages_of_bag<CameraParams>(state, {"/camera/params"}); }
BENCHMARK(params_of_bag)->Name("BM_BagToTake/peer")->Unit(benchmark::kMillisecond);
void tf_of_bag(benchmark::State& state) {
  messages_of_bag<tf2_msgs::TFMessage, sensor_msgs::CameraInfo>(state, {"/tf", "/camera/camera_info"});
}
BENCHMARK(tf_of_bag)->Name("BM_BagOfTfToTake/peer")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trk_bridge::bag

BENCHMARK_MAIN();
