// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// From bags whose recorder died or whose end was lost, every complete record is read.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>

#include <sys/wait.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>
#include <unistd.h>

#include "fixture.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::bag::truncated_test {

using test::read_text;
using test::write_text;
using testing::HasSubstr;

class TruncatedBag : public BagTest {
 protected:
  std::string bag_text(const std::string& compression) {
    TakeToBagOptions options;
    options.compression = compression;
    options.overwrite = true;
    return read_text(to_bag(path, options));
  }

  /// How many fields the first bytes give, all of which must be equal to the take's; none if the bag is refused.
  std::optional<std::size_t> fields_of(const std::string& bytes) {
    write_text(directory / "cut.bag", bytes);
    try {
      const auto back = to_take(directory / "cut.bag");
      EXPECT_EQ(bits(back.constants), bits(sent.constants));
      EXPECT_EQ(back.time_code, sent.time_code);
      EXPECT_LE(back.params.size(), sent.params.size());
      const auto got = bits_of(back.params);
      EXPECT_TRUE(std::equal(got.begin(), got.end(), all.begin())) << "of " << bytes.size() << " bytes";
      return got.size();
    } catch (const BagError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cut.bag"));
      return std::nullopt;
    }
  }

  const std::string path = test::data_path("field/takes/euler.trk");
  const file::Take sent = file::read_take(path);
  const std::vector<std::string> all = bits_of(sent.params);
};

TEST_F(TruncatedBag, GivesEveryCompleteRecordForAnyLength) {
  const std::string bytes = bag_text("none");
  std::size_t before = 0;
  for (std::size_t size = 0; size < bytes.size(); size += 37'077) {
    const std::size_t fields = fields_of(bytes.substr(0, size)).value_or(0);
    // A field takes less than 1000 bytes; the other bytes at the begin and the end of the bag are less than 250000.
    EXPECT_GE(1000 * fields + 250'000, size);
    EXPECT_GE(fields, before);
    before = fields;
  }
  EXPECT_EQ(fields_of(bytes.substr(0, bytes.size() - 1)), all.size()) << "only its index is truncated";
  EXPECT_THAT(err.str(), HasSubstr("cut.bag is truncated: "));
}

TEST_F(TruncatedBag, ATruncatedRecordIsIgnored) {
  const std::string bytes = bag_text("none");
  const std::size_t from = bytes.size() / 3;
  std::size_t steps = 0;
  std::size_t before = fields_of(bytes.substr(0, from)).value_or(0);
  for (std::size_t size = from + 1; size < from + 900; size += 7) {
    const std::size_t fields = fields_of(bytes.substr(0, size)).value_or(0);
    ASSERT_TRUE(fields == before || fields == before + 1) << size;
    steps += fields - before;
    before = fields;
  }
  EXPECT_GE(steps, 1u);
}

TEST_F(TruncatedBag, TruncatedCompressedChunksGiveWhatCanBeUnpacked) {
  for (const char* compression : {"bz2", "lz4"}) {
    const std::string bytes = bag_text(compression);
    std::size_t before = 0;
    for (std::size_t part = 1; part < 20; ++part) {
      const std::size_t fields = fields_of(bytes.substr(0, bytes.size() * part / 20)).value_or(0);
      EXPECT_GE(fields, before) << compression;
      before = fields;
    }
    EXPECT_GT(before, all.size() / 2) << compression;
    EXPECT_EQ(fields_of(bytes.substr(0, bytes.size() - 1)), all.size()) << compression;
  }
}

TEST_F(TruncatedBag, MessagesOfACrashedRecorderAreRead) {
  // Compressed bags are written in chunks of 768 KiB.
  const std::vector<wire::CameraParams> long_take = some_fields(6000);
  const auto long_bits = bits_of(long_take);
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    const std::string active = directory / "take.bag.active";
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      rosbag::Bag bag(active, rosbag::bagmode::Write);
      bag.setCompression(compression);
      CameraConstants constants;
      ros1::to_msg(sent.constants, constants);
      bag.write("/crane/constants", ::ros::Time(100), constants);
      for (std::size_t i = 0; i < long_take.size(); ++i) {
        CameraParams params;
        params.header.stamp = ::ros::Time(100 + 0.02 * static_cast<double>(i));
        ros1::to_msg(long_take[i], params);
        bag.write("/crane/params", params.header.stamp, params);
      }
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    err.str("");
    const auto back = to_take(active);
    EXPECT_THAT(err.str(), HasSubstr("its recorder did not close it"));
    EXPECT_THAT(err.str(), testing::Not(HasSubstr("are missing")));
    EXPECT_GT(back.params.size(), long_take.size() / 4);
    ASSERT_LE(back.params.size(), long_take.size());
    const auto got = bits_of(back.params);
    EXPECT_TRUE(std::equal(got.begin(), got.end(), long_bits.begin()));
  }
}

TEST_F(TruncatedBag, DamageNeverCrashes) {
  std::mt19937 random(1998);
  for (const char* compression : {"none", "bz2", "lz4"}) {
    const std::string whole = bag_text(compression);
    // Without the index, and with it: then the damage is also at its end.
    for (const std::string& bytes : {whole.substr(0, whole.size() * 2 / 3), whole}) {
      for (int round = 0; round < 25; ++round) {
        std::string damaged = bytes;
        for (int i = 0; i < 10; ++i) {
          const std::size_t from = i % 2 == 0 || bytes.size() < whole.size() ? 0 : bytes.size() - 3000;
          damaged[from + random() % (damaged.size() - from)] = static_cast<char>(random());
        }
        write_text(directory / "cut.bag", damaged);
        try {
          EXPECT_LE(to_take(directory / "cut.bag").params.size(), all.size());
        } catch (const std::runtime_error& error) {
          EXPECT_STRNE(error.what(), "");
        }
      }
    }
  }
}

TEST_F(TruncatedBag, FilesThatAreNotBagsAreRefused) {
  write_text(directory / "cut.bag", "DMC01\n");
  EXPECT_THAT(refusal(directory / "cut.bag"), HasSubstr("not a bag"));
  write_text(directory / "cut.bag", "#ROSBAG V2.0\n");
  EXPECT_THAT(refusal(directory / "cut.bag"), HasSubstr("no topic params"));
  write_text(directory / "cut.bag", std::string(5000, 'x'));
  EXPECT_THAT(refusal(directory / "cut.bag"), HasSubstr("not a bag of format 2.0"));
  EXPECT_THAT(refusal(directory / "none.bag"), HasSubstr("No such file"));
}

}  // namespace trk_bridge::bag::truncated_test
