// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The same messages in the same order as with rosbag's library; and memory that does not grow with the bag.
#include <random>
#include <set>

#include <std_msgs/String.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bag/reader.h"
#include "fixture.h"

namespace trk_bridge::bag::reader_test {

using testing::HasSubstr;

class ReaderTest : public BagTest, public testing::WithParamInterface<rosbag::CompressionType> {
 protected:
  static std_msgs::String text(int number) {
    std_msgs::String message;
    message.data = std::to_string(number) + std::string(static_cast<std::size_t>(number % 500), 'x');
    return message;
  }

  /// Small chunks; `time_of` says when a message was recorded.
  std::string bag_of(int messages, const std::function<::ros::Time(int)>& time_of) {
    const std::string path = directory / "some.bag";
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.setCompression(GetParam());
    bag.setChunkThreshold(10'000);
    for (int i = 0; i < messages; ++i) bag.write(i % 3 == 0 ? "/a" : "/b", time_of(i), text(i));
    bag.close();
    return path;
  }

  using Read = std::vector<std::pair<std::string, std::string>>;  // topics and texts
  static Read by_rosbag(const std::string& path) {
    Read read;
    rosbag::Bag bag(path);
    for (const auto& message : rosbag::View(bag)) {
      read.emplace_back(message.getTopic(), message.instantiate<std_msgs::String>()->data);
    }
    return read;
  }
  Read by_us(const std::string& path) {
    Read read;
    Reader bag(path, run);
    EXPECT_EQ(bag.damage(), "");
    bag.read([](const Connection&) { return true; },
             [&](const RawMessage& raw) {
               read.emplace_back(raw.connection.topic, message_of<std_msgs::String>(raw).data);
             });
    return read;
  }
};

TEST_P(ReaderTest, MessagesAreReadInOrderOfTime) {
  std::mt19937 random(1998);
  for (const int reach : {0, 1, 300, 2000}) {
    // No two times are equal: their order is not defined by rosbag.
    std::set<int> used;
    const auto time_of = [&](int i) {
      int time = i + static_cast<int>(random() % static_cast<unsigned>(reach + 1));
      while (!used.insert(time).second) ++time;
      return ::ros::Time(100 + static_cast<std::uint32_t>(time / 50), static_cast<std::uint32_t>(time % 50) * 1000);
    };
    const std::string path = bag_of(2000, time_of);
    const auto read = by_us(path);
    EXPECT_EQ(read.size(), 2000U);
    EXPECT_EQ(read, by_rosbag(path)) << reach;
  }
}

TEST_P(ReaderTest, MessagesWithEqualTimesAreReadInFileOrder) {
  const auto read = by_us(bag_of(500, [](int) { return ::ros::Time(100, 5); }));
  ASSERT_EQ(read.size(), 500U);
  for (int i = 0; i < 500; ++i) ASSERT_EQ(read[static_cast<std::size_t>(i)].second, text(i).data);
}

TEST_P(ReaderTest, OnlyWantedMessagesAreReadUntilTheVisitorStops) {
  Reader bag(bag_of(500, [](int i) { return ::ros::Time(100 + static_cast<std::uint32_t>(i), 0); }), run);
  std::vector<std::string> read;
  bag.read_while([](const Connection& connection) { return connection.topic == "/a"; },
                 [&](const RawMessage& raw) {
                   // A visitor may also read.
                   std::size_t all = 0;
                   bag.read([](const Connection&) { return true; }, [&all](const RawMessage&) { ++all; });
                   EXPECT_EQ(all, 500U);
                   read.push_back(message_of<std_msgs::String>(raw).data);
                   return read.size() < 4;
                 });
  EXPECT_EQ(read, (std::vector<std::string>{text(0).data, text(3).data, text(6).data, text(9).data}));
}

TEST_P(ReaderTest, ADamagedChunkIsNamed) {
  const std::string path = bag_of(500, [](int i) { return ::ros::Time(100 + static_cast<std::uint32_t>(i), 0); });
  std::string bytes = test::read_text(path);
  const std::size_t second = bytes.find("compression=", bytes.find("compression=") + 1);
  ASSERT_NE(second, std::string::npos);
  for (std::size_t i = second + 60; i < second + 400; ++i) bytes[i] = '\xAA';
  test::write_text(path, bytes);
  const std::string error = test::error_of<BagError>([&] { by_us(path); });
  // Its record starts with the sizes of the header and of its first field.
  EXPECT_THAT(error, HasSubstr("the bag is damaged: the chunk at byte " + std::to_string(second - 8) + " "));
}

INSTANTIATE_TEST_SUITE_P(Compressions, ReaderTest,
                         testing::Values(rosbag::compression::Uncompressed, rosbag::compression::BZ2,
                                         rosbag::compression::LZ4),
                         [](const auto& test) { return std::to_string(test.index); });

TEST_F(BagTest, AnEncryptedBagIsRefused) {
  const std::string path = directory / "encrypted.bag";
  const auto sized = [](const std::string& text) {
    const auto size = static_cast<std::uint32_t>(text.size());
    return std::string(reinterpret_cast<const char*>(&size), sizeof size) + text;
  };
  test::write_text(path, "#ROSBAG V2.0\n" + sized(sized("encryptor=rosbag/AesCbcEncryptor") + sized("op=\x03")) +
                             sized(std::string(100, ' ')));
  EXPECT_THAT(refusal(path), HasSubstr("it is encrypted: decrypt it with rosbag decrypt"));
}

/// The most memory that a process needs for this, KiB.
template <typename Action>
long peak_of(const Action& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      action();
      ::_exit(0);
    } catch (...) {
      ::_exit(1);
    }
  }
  int status = 0;
  rusage usage{};
  EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
  EXPECT_EQ(status, 0);
  return usage.ru_maxrss;
}

TEST_F(BagTest, MemoryDoesNotGrowWithTheTake) {
  const std::string few = take_of(some_fields(5'000), "few.trk"), many = take_of(some_fields(50'000), "many.trk");
  const auto growth = [&](const std::function<void(const std::string&, const std::string&)>& convert) {
    const long of_few = peak_of([&] { convert(few, directory / "few.bag"); });
    const long of_many = peak_of([&] { convert(many, directory / "many.bag"); });
    return of_many - of_few;
  };
  // 45,000 fields more: 12 MB of records, or 180,000 entries of an index with 64 bytes each.
  constexpr long allowed = 4'000;
  EXPECT_LT(growth([&](const auto& take, const auto& bag) { bag_of_take(take, bag, {}, run, err); }), allowed);
  for (const auto input : {Input::params, Input::tf}) {
    BagToTakeOptions options;
    options.overwrite = true;
    options.input = input;
    EXPECT_LT(
        growth([&](const auto&, const auto& bag) { take_of_bag(bag, directory / "back.trk", options, run, err); }),
        allowed);
  }
}

}  // namespace trk_bridge::bag::reader_test
