// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "index.h"

#include <rosbag/constants.h>

namespace trk_bridge::bag {
namespace {

std::optional<Chunk> chunk_of(Bytes& file, const Record& record) {
  const auto place = record.header.number<std::uint64_t>(rosbag::CHUNK_POS_FIELD_NAME);
  const auto begin = time_in(record.header, rosbag::START_TIME_FIELD_NAME);
  const auto count = record.header.number<std::uint32_t>(rosbag::COUNT_FIELD_NAME);
  constexpr std::uint32_t entry = 2 * sizeof(std::uint32_t);
  if (!place || !begin || !count || record.size / entry != *count || record.size % entry != 0) {
    return std::nullopt;
  }
  Chunk chunk{*place, *begin, {}};
  chunk.counts.resize(*count);
  const std::string_view data = file.at(record.data, record.size);
  for (std::uint32_t i = 0; i < *count; ++i) {
    std::memcpy(&chunk.counts[i].first, data.data() + std::size_t{i} * entry, sizeof(std::uint32_t));
    std::memcpy(&chunk.counts[i].second, data.data() + std::size_t{i} * entry + entry / 2, sizeof(std::uint32_t));
  }
  return chunk;
}

}  // namespace

void check_magic(Bytes& file) {
  if (file.size() < magic.size()) throw BagError("not a bag: it is shorter than the first line of a bag");
  if (file.at(0, magic.size()) == magic) return;
  throw BagError("not a bag of format 2.0: it does not begin with " + std::string(magic.substr(0, magic.size() - 1)));
}

void check_encryption(const Record& file_header) {
  if (file_header.header.text(rosbag::ENCRYPTOR_FIELD_NAME).empty()) return;
  throw BagError("it is encrypted: decrypt it with rosbag decrypt");
}

std::optional<std::uint64_t> time_in(const HeaderFields& header, const std::string& name) {
  const auto stored = header.number<std::uint64_t>(name);
  if (!stored) return std::nullopt;
  return *stored << 32U | *stored >> 32U;
}

std::optional<Connection> connection_of(Bytes& from, const Record& record) {
  const auto id = record.header.number<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME);
  Connection connection;
  connection.topic = record.header.text(rosbag::TOPIC_FIELD_NAME);
  const auto header = HeaderFields::parse(from.at(record.data, record.size));
  if (!id || !header) return std::nullopt;
  connection.id = *id;
  connection.type = header->text("type");
  connection.md5sum = header->text("md5sum");
  connection.header = header->all();
  return connection;
}

tl::expected<Index, std::string> read_index(Bytes& file) {
  check_magic(file);
  const auto unreadable = [](const std::string& why) {
    return tl::unexpected("its index cannot be read (" + why + ")");
  };
  const auto header = record_at(file, magic.size());
  if (!header || header->op != rosbag::OP_FILE_HEADER) return unreadable("the file header is malformed");
  check_encryption(*header);
  const auto place = header->header.number<std::uint64_t>(rosbag::INDEX_POS_FIELD_NAME);
  const auto connections = header->header.number<std::uint32_t>(rosbag::CONNECTION_COUNT_FIELD_NAME);
  const auto chunks = header->header.number<std::uint32_t>(rosbag::CHUNK_COUNT_FIELD_NAME);
  if (!place || !connections || !chunks) return unreadable("the file header is malformed");
  if (*place == 0) return tl::unexpected(std::string("its recorder did not close it"));
  Index index;
  std::uint64_t at = *place;
  for (auto record = record_at(file, at); record && is_whole(file, *record); record = record_at(file, at)) {
    at = record->data + record->size;
    if (record->op == rosbag::OP_CONNECTION) {
      if (const auto connection = connection_of(file, *record)) index.connections.push_back(*connection);
    } else if (record->op == rosbag::OP_CHUNK_INFO) {
      if (const auto chunk = chunk_of(file, *record)) index.chunks.push_back(*chunk);
    }
  }
  if (index.connections.size() != *connections || index.chunks.size() != *chunks) {
    return unreadable("it has " + std::to_string(index.connections.size()) + " of " + std::to_string(*connections) +
                      " connections and " + std::to_string(index.chunks.size()) + " of " + std::to_string(*chunks) +
                      " chunks");
  }
  return index;
}

}  // namespace trk_bridge::bag
