// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Writes a bag.
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

/// Writes a bag of format 2.0; without compression the same bytes as rosbag::Bag. rosbag::Bag keeps an entry for every
/// message until the bag is closed; this class keeps one chunk of 768 KiB, and less than 200 bytes for each chunk in
/// the file. Everything in the file can be read if the program crashes. Not synchronised.
class Writer {
 public:
  /// Index of a topic.
  using Connection = std::size_t;

  /// `file` is empty and must outlive the writer; the caller publishes it. `compression` is none, bz2 or lz4. All
  /// functions throw std::system_error.
  Writer(file::PartFile& file, std::string compression);

  /// `header` is that of the publisher, without the entries that follow from the message type. It is written with the
  /// first message.
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

  /// Writes the last chunk and the index. Call once, at the end.
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
    std::optional<std::uint32_t> id;  // set with the first message
    std::vector<Entry> entries;       // of the chunk
  };

  /// Returns where to put the bytes of the message.
  std::uint8_t* add_message(Topic&, ::ros::Time, std::uint32_t size);
  static void append_connection(const Topic&, Buffer& into);
  void end_chunk();
  void append_chunk_info();
  void write_index(Topic&);
  std::string file_header(std::int64_t index_place) const;
  /// Appends to the file.
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
