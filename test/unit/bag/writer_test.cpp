// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A bag is equal to what rosbag's library writes for the same messages, byte for byte.
#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>
#include <boost/make_shared.hpp>

#include "bag/writer.h"
#include "fixture.h"

namespace trk_bridge::bag::writer_test {

using test::read_text;

/// The same messages to both.
class TwoBags {
 public:
  TwoBags(const std::string& ours, const std::string& theirs, const std::string& compression)
      : file_(file::PartFile::open(ours, {}).value()), writer_(file_, compression) {
    bag_.open(theirs, rosbag::bagmode::Write);
    bag_.setCompression(compression == "bz2"   ? rosbag::compression::BZ2
                        : compression == "lz4" ? rosbag::compression::LZ4
                                               : rosbag::compression::Uncompressed);
  }

  template <typename Message>
  void connect(const std::string& topic, const ::ros::M_string& header) {
    const auto connection = writer_.connect<Message>(topic, header);
    auto full = boost::make_shared<::ros::M_string>(header);
    (*full)["topic"] = topic;
    (*full)["type"] = ::ros::message_traits::DataType<Message>::value();
    (*full)["md5sum"] = ::ros::message_traits::MD5Sum<Message>::value();
    (*full)["message_definition"] = ::ros::message_traits::Definition<Message>::value();
    topics_.push_back({connection, topic, full});
  }

  template <typename Message>
  void write(std::size_t topic, ::ros::Time time, const Message& message) {
    writer_.write(topics_[topic].connection, time, message);
    bag_.write(topics_[topic].name, time, message, topics_[topic].header);
  }

  void close() {
    writer_.close();
    ASSERT_TRUE(file_.publish());
    bag_.close();
  }

 private:
  struct Topic {
    Writer::Connection connection;
    std::string name;
    boost::shared_ptr<::ros::M_string> header;
  };

  file::PartFile file_;
  Writer writer_;
  rosbag::Bag bag_;
  std::vector<Topic> topics_;
};

class WriterTest : public BagTest, public testing::WithParamInterface<std::string> {};

TEST_P(WriterTest, IsEqualToRosbag) {
  TwoBags bags(directory / "ours.bag", directory / "theirs.bag", GetParam());
  bags.connect<sensor_msgs::CameraInfo>("/never", {{"latching", "1"}});
  bags.connect<sensor_msgs::CameraInfo>("/info", {{"latching", "0"}, {"callerid", "/a"}});
  bags.connect<tf2_msgs::TFMessage>("/tf", {{"extra", std::string("with = and \0", 12)}});
  bags.connect<tf2_msgs::TFMessage>("/late", {});
  sensor_msgs::CameraInfo info;
  tf2_msgs::TFMessage tf;
  for (std::uint32_t i = 0; i < 6000; ++i) {
    // Times go back and repeat.
    const ::ros::Time time(1'700'000'000 + i / 50 - (i % 7 == 0 ? 3 : 0), i % 50 / 2 * 20'000'000);
    info.header.seq = i;
    info.distortion_model = std::string(i % 13, 'x');
    info.K[0] = 1000.0 / (i + 1);
    tf.transforms.resize(i % 4);
    if (i != 3000) bags.write(1, time, info);
    if (i == 3000) info.distortion_model = std::string(3'000'000, 'y');  // longer than a chunk
    if (i == 3000) bags.write(1, time, info);
    if (i % 3 != 0) bags.write(2, time, tf);
    if (i > 5900) bags.write(3, time, tf);
  }
  bags.close();
  const std::string ours = read_text(directory / "ours.bag");
  EXPECT_GT(ours.size(), GetParam() == "none" ? 5'000'000U : 50'000U);
  EXPECT_TRUE(ours == read_text(directory / "theirs.bag"));
}

TEST_P(WriterTest, AnEmptyBagIsValid) {
  TwoBags bags(directory / "ours.bag", directory / "theirs.bag", GetParam());
  bags.connect<sensor_msgs::CameraInfo>("/never", {});
  bags.close();
  EXPECT_TRUE(read_text(directory / "ours.bag") == read_text(directory / "theirs.bag"));
}

INSTANTIATE_TEST_SUITE_P(Compressions, WriterTest, testing::Values("none", "bz2", "lz4"),
                         [](const auto& test) { return test.param; });

}  // namespace trk_bridge::bag::writer_test
