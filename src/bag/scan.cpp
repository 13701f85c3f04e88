// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "scan.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include <rosbag/constants.h>

#include "chunk.h"
#include "index.h"
#include "records.h"

namespace trk_bridge::bag {
namespace {

class Scan {
 public:
  Scan(const std::string& path, const std::function<void(const Connection&)>& on_connection,
       const std::function<bool(const RawMessage&)>& on_message, cli::LongRun& run)
      : path_(path), on_connection_(on_connection), on_message_(on_message), run_(run) {}

  std::string run() {
    FileBytes file(path_);
    check_magic(file);
    const std::uint64_t end = records(file, magic.size(), /*is_file=*/true);
    if (is_enough_) return {};
    std::string result = end == file.size()
                             ? "everything in it was read"
                             : "it is read up to byte " + std::to_string(end) + " of " + std::to_string(file.size());
    if (!chunk_fault_.empty()) result += "; " + chunk_fault_;
    if (unknown_messages_ != 0)
      result += "; " + std::to_string(unknown_messages_) + " messages of unknown topics were ignored";
    return result;
  }

 private:
  /// Reads records as long as they are complete. Returns the position where it stopped.
  std::uint64_t records(Bytes& from, std::uint64_t at, bool is_file) {
    while (!is_enough_) {
      if (is_file) run_.at(static_cast<double>(at) / static_cast<double>(from.size()));
      const auto record = record_at(from, at);
      if (!record) return at;
      if (is_file && record->op == rosbag::OP_CHUNK) {
        at = chunk(from, *record);
        continue;
      }
      if (!is_whole(from, *record)) return at;
      at = record->data + record->size;
      use(from, *record);
    }
    return at;
  }

  void use(Bytes& from, const Record& record) {
    if (record.op == rosbag::OP_FILE_HEADER) check_encryption(record);
    if (record.op == rosbag::OP_CONNECTION) {
      const auto id = record.header.number<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME);
      if (id && connections_.count(*id) != 0) return;
      const auto found = connection_of(from, record);
      if (found) on_connection_(connections_[found->id] = *found);
    }
    if (record.op == rosbag::OP_MSG_DATA) {
      const auto id = record.header.number<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME);
      const auto known = id ? connections_.find(*id) : connections_.end();
      if (known == connections_.end()) {
        ++unknown_messages_;
      } else if (on_message_) {
        is_enough_ = !on_message_({known->second, from.at(record.data, record.size)});
      }
    }
  }

  /// Returns the position of the next record.
  std::uint64_t chunk(Bytes& from, const Record& record) {
    const std::string compression(record.header.text(rosbag::COMPRESSION_FIELD_NAME));
    // Records of an uncompressed chunk are read like records of the file. So the unfinished chunk, whose size was never
    // written, needs no special case.
    if (compression == rosbag::COMPRESSION_NONE) return record.data;
    const std::uint64_t there = from.size() - record.data;
    const std::uint64_t packed_size = record.size == 0 ? there : std::min<std::uint64_t>(record.size, there);
    const std::string_view packed = from.at(record.data, packed_size);
    packed_.assign(packed.begin(), packed.end());
    const auto unpacked = unpack_chunk(compression, packed_);
    if (!unpacked.fault.empty()) {
      chunk_fault_ = "the chunk at byte " + std::to_string(record.data) + " " + unpacked.fault;
    }
    MemoryBytes records_of_chunk(unpacked.bytes);
    records(records_of_chunk, 0, /*is_file=*/false);
    return record.data + packed_size;
  }

  const std::string& path_;
  const std::function<void(const Connection&)>& on_connection_;
  const std::function<bool(const RawMessage&)>& on_message_;
  cli::LongRun& run_;
  std::map<std::uint32_t, Connection> connections_;
  std::vector<std::uint8_t> packed_;
  bool is_enough_ = false;
  std::string chunk_fault_;
  std::uint64_t unknown_messages_ = 0;
};

}  // namespace

std::string scan_bag(const std::string& path, const std::function<void(const Connection&)>& on_connection,
                     const std::function<bool(const RawMessage&)>& on_message, cli::LongRun& run) {
  return Scan(path, on_connection, on_message, run).run();
}

}  // namespace trk_bridge::bag
