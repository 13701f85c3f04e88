// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "reader.h"

#include <algorithm>
#include <utility>

#include <rosbag/constants.h>

#include "chunk.h"
#include "index.h"
#include "scan.h"

namespace trk_bridge::bag {
namespace {

/// A chunk in memory and its messages of the wanted connections.
class LoadedChunk {
 public:
  using Wanted = std::map<std::uint32_t, const Connection*>;

  LoadedChunk(Bytes& file, std::uint64_t place, const Wanted& wanted) {
    const auto damaged = [place](const std::string& how) {
      return BagError("the bag is damaged: the chunk at byte " + std::to_string(place) + " " + how);
    };
    const auto record = record_at(file, place);
    if (!record || record->op != rosbag::OP_CHUNK || !is_whole(file, *record)) throw damaged("is not there");
    const std::string compression(record->header.text(rosbag::COMPRESSION_FIELD_NAME));
    const std::string_view data = file.at(record->data, record->size);
    bytes_.assign(data.begin(), data.end());
    if (compression != rosbag::COMPRESSION_NONE) {
      auto unpacked = unpack_chunk(compression, bytes_);
      if (!unpacked.fault.empty()) throw damaged(unpacked.fault);
      bytes_ = std::move(unpacked.bytes);
    }
    if (!find_messages(wanted)) throw damaged("has a malformed record");
    const auto by_time = [](const Message& one, const Message& other) { return one.time < other.time; };
    std::stable_sort(messages_.begin(), messages_.end(), by_time);
  }

  bool is_empty() const { return next_ == messages_.size(); }
  /// Seconds and nanoseconds of the next message.
  std::uint64_t time() const { return messages_[next_].time; }
  RawMessage take() {
    const Message& message = messages_[next_++];
    return {*message.connection, {reinterpret_cast<const char*>(bytes_.data()) + message.place, message.size}};
  }

 private:
  struct Message {
    std::uint64_t time;
    const Connection* connection;
    std::uint64_t place;
    std::uint32_t size;
  };

  bool find_messages(const Wanted& wanted) {
    MemoryBytes bytes(bytes_);
    for (std::uint64_t at = 0; at < bytes.size();) {
      const auto record = record_at(bytes, at);
      if (!record || !is_whole(bytes, *record)) return false;
      at = record->data + record->size;
      if (record->op != rosbag::OP_MSG_DATA) continue;
      const auto id = record->header.number<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME);
      const auto time = time_in(record->header, rosbag::TIME_FIELD_NAME);
      if (!id || !time) return false;
      const auto found = wanted.find(*id);
      if (found != wanted.end()) messages_.push_back({*time, found->second, record->data, record->size});
    }
    return true;
  }

  std::vector<std::uint8_t> bytes_;
  std::vector<Message> messages_;
  std::size_t next_ = 0;
};

}  // namespace

Reader::Reader(std::string path, cli::LongRun& run) : path_(std::move(path)), run_(run) {
  run_.begin("reading " + path_);
  FileBytes file(path_);
  if (auto index = read_index(file)) {
    index_ = std::make_unique<Index>(*std::move(index));
    connections_ = index_->connections;
    return;
  } else {
    damage_ = index.error();
  }
  damage_ += "; " + scan_bag(
                        path_, [this](const Connection& found) { connections_.push_back(found); }, {}, run_);
}

Reader::~Reader() = default;

void Reader::read(const Filter& wanted, const Visitor& visit) {
  read_while(wanted, [&visit](const RawMessage& message) {
    visit(message);
    return true;
  });
}

void Reader::read_while(const Filter& wanted, const std::function<bool(const RawMessage&)>& visit) {
  run_.begin("reading " + path_);
  if (index_) return read_indexed(wanted, visit);
  scan_bag(
      path_, [](const Connection&) {},
      [&](const RawMessage& message) { return !wanted(message.connection) || visit(message); }, run_);
}

void Reader::read_indexed(const Filter& wanted, const std::function<bool(const RawMessage&)>& visit) {
  LoadedChunk::Wanted connections;
  for (const auto& connection : connections_) {
    if (wanted(connection)) connections[connection.id] = &connection;
  }
  std::vector<const Chunk*> chunks;
  double total = 0;
  for (const auto& chunk : index_->chunks) {
    std::uint64_t in_chunk = 0;
    for (const auto& [id, count] : chunk.counts) in_chunk += connections.count(id) != 0 ? count : 0;
    if (in_chunk > 0) chunks.push_back(&chunk);
    total += static_cast<double>(in_chunk);
  }
  const auto by_begin = [](const Chunk* one, const Chunk* other) {
    return std::pair(one->begin, one->place) < std::pair(other->begin, other->place);
  };
  std::sort(chunks.begin(), chunks.end(), by_begin);

  FileBytes file(path_);
  // Ordered by the time of the next message; equal times by position in the file.
  std::map<std::pair<std::uint64_t, std::uint64_t>, LoadedChunk> loaded;
  double done = 0;
  for (auto next = chunks.begin(); next != chunks.end() || !loaded.empty();) {
    if (next != chunks.end() && (loaded.empty() || (*next)->begin <= loaded.begin()->first.first)) {
      LoadedChunk chunk(file, (*next)->place, connections);
      if (!chunk.is_empty()) loaded.emplace(std::pair(chunk.time(), (*next)->place), std::move(chunk));
      ++next;
      continue;
    }
    run_.at(done++ / total);
    auto first = loaded.extract(loaded.begin());
    LoadedChunk& chunk = first.mapped();
    if (!visit(chunk.take())) return;
    if (chunk.is_empty()) continue;
    first.key().first = chunk.time();
    loaded.insert(std::move(first));
  }
}

}  // namespace trk_bridge::bag
