// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads a complete or truncated bag.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/time.h>

#include "cli/long_run.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::bag {

struct Index;

/// Why a bag cannot be used; the text does not contain its name.
class BagError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Connection {
  std::uint32_t id = 0;
  std::string topic, type, md5sum;
  std::map<std::string, std::string> header;  ///< of the publisher, with entries that the writer of the bag added
};

/// Valid during the visit.
struct RawMessage {
  const Connection& connection;
  std::string_view bytes;  ///< serialised
};

/// Whether the connection has this message type, with the definition that this program was built with.
template <typename Message>
bool carries(const Connection& connection) {
  return connection.md5sum == ::ros::message_traits::md5sum<Message>();
}

/// Throws BagError if the bytes are not exactly one message.
template <typename Message>
Message message_of(const RawMessage& message) {
  Message result;
  // The stream only reads, but needs a pointer to non-const.
  auto* const bytes = reinterpret_cast<std::uint8_t*>(const_cast<char*>(message.bytes.data()));
  ::ros::serialization::IStream stream(bytes, static_cast<std::uint32_t>(message.bytes.size()));
  try {
    ::ros::serialization::deserialize(stream, result);
  } catch (const std::exception&) {
    throw BagError("a message of " + message.connection.topic + " is shorter than its type");
  }
  if (stream.getLength() != 0) throw BagError("a message of " + message.connection.topic + " is longer than its type");
  return result;
}

/// The stamp in the header of a message, ns since 1970.
template <typename Message>
std::int64_t stamp_of(const Message& message) {
  return ros1::from_time(message.header.stamp);
}

/// Reads a bag of format 2.0 chunk by chunk. Keeps the positions of all chunks in memory, and the chunks whose times
/// overlap (in a bag of a recorder one or two, of 768 KiB each unless a message is longer). Never writes the file. Not
/// synchronised; a visitor may call read().
class Reader {
 public:
  /// Throws BagError, and Interrupted.
  Reader(std::string path, cli::LongRun&);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const std::vector<Connection>& connections() const noexcept { return connections_; }
  /// Why it is not complete; empty if it is.
  const std::string& damage() const noexcept { return damage_; }

  using Filter = std::function<bool(const Connection&)>;
  using Visitor = std::function<void(const RawMessage&)>;
  /// Visits the messages of the connections for which `wanted` is true, in order of recording time, with equal times in
  /// file order; without an index all in file order. Throws BagError, and Interrupted.
  void read(const Filter& wanted, const Visitor& visit);
  /// The same until `visit` returns false.
  void read_while(const Filter& wanted, const std::function<bool(const RawMessage&)>& visit);

 private:
  void read_indexed(const Filter& wanted, const std::function<bool(const RawMessage&)>& visit);

  std::string path_;
  cli::LongRun& run_;
  std::unique_ptr<Index> index_;  // none if the bag must be scanned
  std::vector<Connection> connections_;
  std::string damage_;
};

}  // namespace trk_bridge::bag
