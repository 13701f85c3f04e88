// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Bags and takes in a temporary directory.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "bag/convert.h"
#include "error_of.h"
#include "file/take_writer.h"
#include "record_bits.h"
#include "temporary_directory.h"
#include "trk_bridge/wire/codec.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::bag {

using test::bits;

inline std::vector<std::string> bits_of(const std::vector<wire::CameraParams>& params) {
  std::vector<std::string> all;
  for (const auto& one : params) all.push_back(bits(one));
  return all;
}

inline wire::CameraParams some_params(std::uint64_t counter, std::uint32_t id = 0) {
  wire::CameraParams params;
  params.id = id;
  params.format = 1;
  params.euler = {1.0 / 3.0, -2, 1.5 + 0.001 * static_cast<double>(counter), 179.99999, 5, 6};
  params.fov = 7.7;
  params.k1 = 1e-3;
  params.focdist = 2.5;
  params.aperture = 4;
  params.counter = counter;
  return params;
}

inline wire::CameraConstants some_constants(std::uint32_t id = 0) {
  return {id, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39};
}

class BagTest : public ::testing::Test {
 protected:
  std::string take_of(const std::vector<wire::CameraParams>& params, const std::string& name = "made.trk",
                      const base::TimeCode& code = {10, 20, 30, 12, 1}) {
    const std::string path = directory / name;
    file::TakeWriter writer(path, code, /*overwrite=*/true);
    EXPECT_TRUE(writer.write(some_constants(params.empty() ? 0 : params.front().id)));
    for (const auto& one : params) EXPECT_TRUE(writer.write(one));
    EXPECT_TRUE(writer.close());
    return path;
  }

  std::vector<wire::CameraParams> some_fields(std::uint64_t count, std::uint32_t id = 0) {
    std::vector<wire::CameraParams> fields;
    for (std::uint64_t i = 0; i < count; ++i) fields.push_back(some_params(1000 + i, id));
    return fields;
  }

  std::string to_bag(const std::string& take, const TakeToBagOptions& options = {}, const std::string& name = "a.bag") {
    bag_of_take(take, directory / name, options, run, err);
    return directory / name;
  }
  file::Take to_take(const std::string& bag, BagToTakeOptions options = {}) {
    options.overwrite = true;
    take_of_bag(bag, directory / "back.trk", options, run, err);
    return file::read_take(directory / "back.trk");
  }
  std::string refusal(const std::string& bag, const BagToTakeOptions& options = {}) {
    const std::string take = directory / "refused.trk";
    std::string error = test::error_of<std::runtime_error>([&] { take_of_bag(bag, take, options, run, err); });
    EXPECT_FALSE(std::filesystem::exists(take));
    EXPECT_FALSE(std::filesystem::exists(take + ".part"));
    return error;
  }

  test::TemporaryDirectory directory;
  std::ostringstream err;
  cli::LongRun run{err, /*is_terminal=*/false};
};

/// A bag as other programs write it.
class SomeBag {
 public:
  explicit SomeBag(std::string path, rosbag::CompressionType compression = rosbag::compression::Uncompressed)
      : path_(std::move(path)) {
    bag_.open(path_, rosbag::bagmode::Write);
    bag_.setCompression(compression);
  }
  template <typename Message>
  void put(const std::string& topic, double seconds, const Message& message) {
    bag_.write(topic, ::ros::Time(seconds), message);
  }
  const std::string& closed() {
    bag_.close();
    return path_;
  }

 private:
  std::string path_;
  rosbag::Bag bag_;
};

}  // namespace trk_bridge::bag
