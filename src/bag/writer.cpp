// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "writer.h"

#include <algorithm>
#include <cstring>
#include <system_error>
#include <type_traits>
#include <utility>

#include <rosbag/constants.h>

#include "chunk.h"
#include "records.h"

namespace trk_bridge::bag {
namespace {

using Buffer = std::vector<std::uint8_t>;

std::string_view text_of(const Buffer& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

void append(Buffer& into, std::string_view text) { into.insert(into.end(), text.begin(), text.end()); }

template <typename Number>
void append_number(Buffer& into, Number number) {
  append(into, {reinterpret_cast<const char*>(&number), sizeof number});
}

/// Appends what `fill` appends, preceded by its size in four bytes.
template <typename Fill>
void append_sized(Buffer& into, const Fill& fill) {
  const std::size_t at = into.size();
  append_number(into, std::uint32_t{0});
  fill();
  const auto size = static_cast<std::uint32_t>(into.size() - at - sizeof(std::uint32_t));
  std::memcpy(into.data() + at, &size, sizeof size);
}

void append_field(Buffer& into, std::string_view name, std::string_view value) {
  append_number(into, static_cast<std::uint32_t>(name.size() + 1 + value.size()));
  append(into, name);
  into.push_back(rosbag::FIELD_DELIM);
  append(into, value);
}

template <typename Number, typename = std::enable_if_t<std::is_integral_v<Number>>>
void append_field(Buffer& into, std::string_view name, Number number) {
  append_field(into, name, std::string_view(reinterpret_cast<const char*>(&number), sizeof number));
}

void append_field(Buffer& into, std::string_view name, ::ros::Time time) {
  append_field(into, name, static_cast<std::uint64_t>(time.nsec) << 32U | time.sec);
}

}  // namespace

Writer::Writer(file::PartFile& file, std::string compression) : file_(file), compression_(std::move(compression)) {
  write(magic);
  // The position of the index stays 0 until the end: this marks the bag as incomplete.
  write(file_header(0));
}

void Writer::write(std::string_view bytes) {
  if (const auto written = file_.write(bytes, size_); !written) {
    throw std::system_error(written.error(), std::system_category());
  }
  size_ += static_cast<std::int64_t>(bytes.size());
}

std::string Writer::file_header(std::int64_t index_place) const {
  Buffer header;
  append_sized(header, [&] {
    append_field(header, rosbag::CHUNK_COUNT_FIELD_NAME, chunk_count_);
    append_field(header, rosbag::CONNECTION_COUNT_FIELD_NAME, connection_count_);
    append_field(header, rosbag::INDEX_POS_FIELD_NAME, index_place);
    append_field(header, rosbag::OP_FIELD_NAME, rosbag::OP_FILE_HEADER);
  });
  const std::size_t padding = rosbag::FILE_HEADER_LENGTH - (header.size() - sizeof(std::uint32_t));
  append_sized(header, [&] { header.resize(header.size() + padding, ' '); });
  return std::string(text_of(header));
}

std::uint8_t* Writer::add_message(Topic& topic, ::ros::Time time, std::uint32_t size) {
  if (chunk_.empty()) begin_ = end_ = time;
  begin_ = std::min(begin_, time);
  end_ = std::max(end_, time);
  if (!topic.id) {
    topic.id = connection_count_++;
    append_connection(topic, chunk_);
    append_connection(topic, connection_records_);
  }
  topic.entries.push_back({time, static_cast<std::uint32_t>(chunk_.size())});
  append_sized(chunk_, [&] {
    append_field(chunk_, rosbag::CONNECTION_FIELD_NAME, *topic.id);
    append_field(chunk_, rosbag::OP_FIELD_NAME, rosbag::OP_MSG_DATA);
    append_field(chunk_, rosbag::TIME_FIELD_NAME, time);
  });
  append_number(chunk_, size);
  chunk_.resize(chunk_.size() + size);
  return chunk_.data() + chunk_.size() - size;
}

void Writer::append_connection(const Topic& topic, Buffer& into) {
  append_sized(into, [&] {
    append_field(into, rosbag::CONNECTION_FIELD_NAME, *topic.id);
    append_field(into, rosbag::OP_FIELD_NAME, rosbag::OP_CONNECTION);
    append_field(into, rosbag::TOPIC_FIELD_NAME, topic.name);
  });
  append_sized(into, [&] {
    for (const auto& [name, value] : topic.header) append_field(into, name, value);
  });
}

void Writer::end_chunk() {
  Buffer record;
  append_sized(record, [&] {
    append_field(record, rosbag::COMPRESSION_FIELD_NAME, compression_);
    append_field(record, rosbag::OP_FIELD_NAME, rosbag::OP_CHUNK);
    append_field(record, rosbag::SIZE_FIELD_NAME, static_cast<std::uint32_t>(chunk_.size()));
  });
  append_chunk_info();
  const bool is_plain = compression_ == rosbag::COMPRESSION_NONE;
  const Buffer packed = is_plain ? Buffer() : pack_chunk(compression_, chunk_);
  const Buffer& data = is_plain ? chunk_ : packed;
  append_number(record, static_cast<std::uint32_t>(data.size()));
  write(text_of(record));
  write(text_of(data));
  chunk_.clear();
  for (auto& topic : topics_) write_index(topic);
}

/// The info record of the current chunk, which will be written at the end of the file.
void Writer::append_chunk_info() {
  const auto is_in_chunk = [](const Topic& topic) { return !topic.entries.empty(); };
  const auto count = static_cast<std::uint32_t>(std::count_if(topics_.begin(), topics_.end(), is_in_chunk));
  ++chunk_count_;
  append_sized(chunk_infos_, [&] {
    append_field(chunk_infos_, rosbag::CHUNK_POS_FIELD_NAME, size_);
    append_field(chunk_infos_, rosbag::COUNT_FIELD_NAME, count);
    append_field(chunk_infos_, rosbag::END_TIME_FIELD_NAME, end_);
    append_field(chunk_infos_, rosbag::OP_FIELD_NAME, rosbag::OP_CHUNK_INFO);
    append_field(chunk_infos_, rosbag::START_TIME_FIELD_NAME, begin_);
    append_field(chunk_infos_, rosbag::VER_FIELD_NAME, rosbag::CHUNK_INFO_VERSION);
  });
  append_sized(chunk_infos_, [&] {
    for (const auto& topic : topics_) {
      if (!is_in_chunk(topic)) continue;
      append_number(chunk_infos_, *topic.id);
      append_number(chunk_infos_, static_cast<std::uint32_t>(topic.entries.size()));
    }
  });
}

void Writer::write_index(Topic& topic) {
  if (topic.entries.empty()) return;
  const auto by_time = [](const Entry& one, const Entry& other) { return one.time < other.time; };
  std::stable_sort(topic.entries.begin(), topic.entries.end(), by_time);
  Buffer record;
  append_sized(record, [&] {
    append_field(record, rosbag::CONNECTION_FIELD_NAME, *topic.id);
    append_field(record, rosbag::COUNT_FIELD_NAME, static_cast<std::uint32_t>(topic.entries.size()));
    append_field(record, rosbag::OP_FIELD_NAME, rosbag::OP_INDEX_DATA);
    append_field(record, rosbag::VER_FIELD_NAME, rosbag::INDEX_VERSION);
  });
  append_sized(record, [&] {
    for (const auto& entry : topic.entries) {
      append_number(record, entry.time.sec);
      append_number(record, entry.time.nsec);
      append_number(record, entry.offset);
    }
  });
  write(text_of(record));
  topic.entries.clear();
}

void Writer::close() {
  if (!chunk_.empty()) end_chunk();
  const std::int64_t index_place = size_;
  write(text_of(connection_records_));
  write(text_of(chunk_infos_));
  const std::int64_t end = std::exchange(size_, static_cast<std::int64_t>(magic.size()));
  write(file_header(index_place));
  size_ = end;
}

}  // namespace trk_bridge::bag
