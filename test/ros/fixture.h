// What tests of whole nodes need: a node as a process of its own, what it publishes, and places to send to.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include "program.h"
#include "trk_bridge/wire/codec.h"
#include "udp.h"

namespace trk_bridge::test {

/// Handles ROS callbacks until `condition` is met or the deadline has passed; whether it was met.
bool eventually(const std::function<bool()>& condition, std::chrono::nanoseconds within = deadline);

/// Whether the node `publisher` sends what it publishes to this subscriber. Asked of the publisher: a subscriber
/// believes so before the other end knows of it, and /tf has other publishers.
bool is_served(const ::ros::Subscriber& subscriber, const std::string& publisher);

/// Whether some node publishes on this topic.
bool is_advertised(const std::string& topic);

/// Messages of one topic, in order of arrival.
template <typename Message>
class Recorder {
 public:
  explicit Recorder(const std::string& topic) {
    subscriber_ = ::ros::NodeHandle().subscribe<Message>(
        topic, 10000, [this](const boost::shared_ptr<const Message>& message) { messages.push_back(*message); });
  }
  bool connected_to(const std::string& publisher) const { return is_served(subscriber_, publisher); }

  std::vector<Message> messages;

 private:
  ::ros::Subscriber subscriber_;
};

/// Transforms to one child frame, of /tf or /tf_static.
class TransformRecorder {
 public:
  TransformRecorder(const std::string& topic, std::string child);
  bool connected_to(const std::string& publisher) const { return is_served(subscriber_, publisher); }

  std::vector<geometry_msgs::TransformStamped> transforms;

 private:
  ::ros::Subscriber subscriber_;
};

/// The newest status of every name on /diagnostics.
class DiagnosticsRecorder {
 public:
  DiagnosticsRecorder();
  /// Anew; what was received is kept.
  void subscribe();
  const diagnostic_msgs::DiagnosticStatus* find(const std::string& name) const;
  /// "" when there is no such status or key.
  std::string value(const std::string& name, const std::string& key) const;
  /// Waits until the value is this.
  ::testing::AssertionResult becomes(const std::string& name, const std::string& key, const std::string& expected);
  /// Waits until the summary has this level and contains `text`.
  ::testing::AssertionResult tells(const std::string& name, int level, const std::string& text);

 private:
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> newest_;
  ::ros::Subscriber subscriber_;
};

/// Sends to one port of 127.0.0.1.
class Tracker {
 public:
  explicit Tracker(std::uint16_t port) : port_(port) {}

  void send_bytes(const std::string& bytes) const { socket_.send(bytes, "127.0.0.1", port_); }
  template <typename RecordType>
  void send(const RecordType& record, wire::WireForm form = {}) const {
    send_bytes(datagram(record, form));
  }

 private:
  PlainSocket socket_;
  std::uint16_t port_;
};

/// A port of 127.0.0.1 that nobody is bound to.
inline std::uint16_t free_udp_port() { return PlainSocket().port(); }
std::string udp_url(std::uint16_t port);

/// One camera's node in a namespace of its own, made for one test.
class NodeTest : public ::testing::Test {
 protected:
  /// Of trk_to_ros, or of another program, whose name the node bears.
  explicit NodeTest(const std::string& program = TRK_TO_ROS);

  /// Sets a private parameter.
  template <typename T>
  void set(const std::string& key, const T& value) {
    ::ros::param::set(node_name + "/" + key, value);
  }
  void start();
  /// Starts it and waits until it has told the state of camera `told_of`.
  ::testing::AssertionResult starts(const std::string& told_of);
  ::testing::AssertionResult starts() { return starts(camera); }
  /// Expects it to end with 1 at once and returns what it said.
  std::string refusal();
  /// Ends it as Ctrl-C does; how long that took.
  std::chrono::nanoseconds interrupted();
  std::string status_name(const std::string& of_camera) const { return node_name.substr(1) + ": " + of_camera; }
  std::string status_name() const { return status_name(camera); }

  std::string program_path;
  std::string camera;      ///< its name, unique in this run
  std::string name_space;  ///< "/" + camera
  std::string node_name;
  DiagnosticsRecorder diagnostics;
  std::unique_ptr<Program> node;
};

}  // namespace trk_bridge::test
