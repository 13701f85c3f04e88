// What a bag holds, be it whole or cut short.
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

/// Why a bag cannot be used; the text does not name it.
class BagError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Connection {
  std::uint32_t id = 0;
  std::string topic, type, md5sum;
  std::map<std::string, std::string> header;  ///< of the publisher, with whatever else the bag's writer put there
};

/// Valid while it is visited.
struct RawMessage {
  const Connection& connection;
  std::string_view bytes;  ///< serialised
};

/// Whether the connection carries this message, as it was when this program was built.
template <typename Message>
bool carries(const Connection& connection) {
  return connection.md5sum == ::ros::message_traits::md5sum<Message>();
}

/// Throws BagError when the bytes are not exactly one message.
template <typename Message>
Message message_of(const RawMessage& message) {
  Message result;
  // The stream reads only, but asks for bytes that may be written.
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

/// Of a message's header, ns since 1970.
template <typename Message>
std::int64_t stamp_of(const Message& message) {
  return ros1::from_time(message.header.stamp);
}

/// Reads a bag of format 2.0 chunk by chunk. In memory are the chunks whose times overlap at one moment (of a
/// recorder's bag one or two, of 768 KiB each unless a message is longer), and where all chunks are. The file is never
/// written. Not synchronised; a visitor may read, too.
class Reader {
 public:
  /// Throws BagError, and Interrupted.
  Reader(std::string path, cli::LongRun&);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const std::vector<Connection>& connections() const noexcept { return connections_; }
  /// Why it is not whole; empty when it is.
  const std::string& damage() const noexcept { return damage_; }

  using Filter = std::function<bool(const Connection&)>;
  using Visitor = std::function<void(const RawMessage&)>;
  /// Visits the messages of the connections that `wanted` is true for, in the order of their times of recording, and of
  /// equal times as they stand in the file; without an index all as they stand in the file. Throws BagError, and
  /// Interrupted.
  void read(const Filter& wanted, const Visitor& visit);
  /// The same until `visit` returns false.
  void read_while(const Filter& wanted, const std::function<bool(const RawMessage&)>& visit);

 private:
  void read_indexed(const Filter& wanted, const std::function<bool(const RawMessage&)>& visit);

  std::string path_;
  cli::LongRun& run_;
  std::unique_ptr<Index> index_;  // none when it has to be scanned
  std::vector<Connection> connections_;
  std::string damage_;
};

}  // namespace trk_bridge::bag
