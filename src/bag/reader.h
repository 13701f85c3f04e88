// What a bag holds, be it whole or cut short.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/time.h>

#include "cli/long_run.h"
#include "trk_bridge/ros/messages.h"

namespace rosbag {
class Bag;
}

namespace trk_bridge::bag {

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
  const std::vector<std::uint8_t>& bytes;  ///< serialised
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
  ::ros::serialization::IStream stream(const_cast<std::uint8_t*>(message.bytes.data()),
                                       static_cast<std::uint32_t>(message.bytes.size()));
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

/// Open for reading; the file is never written. Not synchronised.
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
  /// Visits the messages of the connections that `wanted` is true for, in the order of their recording. Throws
  /// BagError, and Interrupted.
  void read(const Filter& wanted, const Visitor& visit);

 private:
  bool open();
  void read_indexed(const Filter& wanted, const Visitor& visit);

  std::string path_;
  cli::LongRun& run_;
  std::unique_ptr<rosbag::Bag> bag_;  // none when it has to be scanned
  std::vector<Connection> connections_;
  std::string damage_;
};

}  // namespace trk_bridge::bag
