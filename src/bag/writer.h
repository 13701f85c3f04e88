// Writing a bag.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <ros/datatypes.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/time.h>

#include "file/part_file.h"

namespace trk_bridge::bag {

/// A bag of format 2.0, as rosbag::Bag writes it, byte for byte where it is not compressed. That one keeps an entry for
/// every message until the bag is closed; this one keeps a chunk of 768 KiB, and a record of less than 200 bytes of
/// each chunk that is in the file. What is in the file can be read when the program dies. Not synchronised.
class Writer {
 public:
  /// Of a topic.
  using Connection = std::size_t;

  /// `file` is an empty one, and lives longer; it is published by the caller. `compression` is none, bz2 or lz4. Throws
  /// std::system_error, as do the others.
  Writer(file::PartFile& file, std::string compression);

  /// `header` is the publisher's, without what follows from the message. It is in the bag once a message is.
  template <typename Message>
  Connection connect(const std::string& topic, ::ros::M_string header) {
    header["topic"] = topic;
    header["type"] = ::ros::message_traits::datatype<Message>();
    header["md5sum"] = ::ros::message_traits::md5sum<Message>();
    header["message_definition"] = ::ros::message_traits::definition<Message>();
    topics_.push_back({topic, std::move(header), {}, {}});
    return topics_.size() - 1;
  }

  /// `message` must be of the connection's type.
  template <typename Message>
  void write(Connection connection, ::ros::Time time, const Message& message) {
    const std::uint32_t size = ::ros::serialization::serializationLength(message);
    ::ros::serialization::OStream stream(add_message(topics_[connection], time, size), size);
    ::ros::serialization::serialize(stream, message);
    if (chunk_.size() > chunk_size) end_chunk();
  }

  /// Brings the last chunk and the index into the file. To be called once, at the end.
  void close();

 private:
  using Buffer = std::vector<std::uint8_t>;
  static constexpr std::size_t chunk_size = std::size_t{768} << 10U;

  struct Entry {
    ::ros::Time time;
    std::uint32_t offset;  // in the chunk
  };
  struct Topic {
    std::string name;
    ::ros::M_string header;
    std::optional<std::uint32_t> id;  // once there is a message
    std::vector<Entry> entries;       // of the chunk
  };

  /// Where the message's bytes belong.
  std::uint8_t* add_message(Topic&, ::ros::Time, std::uint32_t size);
  static void append_connection(const Topic&, Buffer& into);
  void end_chunk();
  void append_chunk_info();
  void write_index(Topic&);
  std::string file_header(std::int64_t index_place) const;
  /// Behind what was written before.
  void write(std::string_view bytes);

  file::PartFile& file_;
  const std::string compression_;
  std::int64_t size_ = 0;  // of the file
  std::vector<Topic> topics_;
  std::uint32_t connection_count_ = 0, chunk_count_ = 0;
  Buffer chunk_;
  ::ros::Time begin_, end_;  // of the chunk
  Buffer connection_records_, chunk_infos_;
};

}  // namespace trk_bridge::bag
