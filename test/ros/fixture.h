// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// For tests of complete nodes: a node in the process of the test, what it publishes, and ports to send to.
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <tf2_msgs/TFMessage.h>

#include "nodes/ros_to_trk.h"
#include "nodes/trk_to_ros.h"
#include "trk_bridge/wire/codec.h"
#include "udp.h"

namespace trk_bridge::test {

/// Handles ROS callbacks until `condition` is met or the deadline has passed; whether it was met.
bool eventually(const std::function<bool()>& condition, std::chrono::nanoseconds within = deadline);

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

  std::vector<Message> messages;

 private:
  ::ros::Subscriber subscriber_;
};

/// What nodes log, from the topic /rosout.
class LogRecorder {
 public:
  bool has(const std::string& text) const;

 private:
  Recorder<rosgraph_msgs::Log> log_{"/rosout"};
};

/// Transforms to one child frame, of /tf or /tf_static.
class TransformRecorder {
 public:
  TransformRecorder(const std::string& topic, std::string child);

  std::vector<geometry_msgs::TransformStamped> transforms;

 private:
  ::ros::Subscriber subscriber_;
};

/// The newest status of every name on a topic of diagnostics.
class DiagnosticsRecorder {
 public:
  explicit DiagnosticsRecorder(const std::string& topic);
  std::string topic() const { return subscriber_.getTopic(); }
  const diagnostic_msgs::DiagnosticStatus* find(const std::string& name) const;
  /// "" if there is no such status or key.
  std::string value(const std::string& name, const std::string& key) const;
  /// Waits until the value is this.
  ::testing::AssertionResult becomes(const std::string& name, const std::string& key, const std::string& expected);
  /// Waits until the summary has this level and contains `text`.
  ::testing::AssertionResult reports(const std::string& name, int level, const std::string& text);

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

/// One camera in a separate namespace for one test, and the parameters of its node.
class CameraTest : public ::testing::Test {
 protected:
  explicit CameraTest(const std::string& node);

  /// Sets a private parameter of the node.
  template <typename T>
  void set(const std::string& key, const T& value) {
    ::ros::param::set(node_name + "/" + key, value);
  }
  /// Waits until the node has reported the state of `subject`: its threads have started.
  ::testing::AssertionResult reports_on(const std::string& subject);
  /// The UDP port in the diagnostics of `of_camera`.
  std::uint16_t port(const std::string& of_camera) const;
  std::uint16_t port() const { return port(camera); }
  std::string status_name(const std::string& subject) const { return node_name.substr(1) + ": " + subject; }
  std::string status_name() const { return status_name(camera); }

  std::string camera;      ///< its name, unique in this run
  std::string name_space;  ///< "/" + camera
  std::string node_name;
  /// On a topic of the camera, which has no other publisher before or after.
  DiagnosticsRecorder diagnostics;
};

/// The node runs in the process of the test. Subscribers of the test receive its messages as soon as both exist:
/// neither waits for the master. Its callbacks are called while the test waits in eventually().
template <typename Node>
class NodeTest : public CameraTest {
 protected:
  /// `name` is the name of the program.
  explicit NodeTest(const std::string& name) : CameraTest(name) {}

  void start() {
    const ::ros::M_string remapped{{"/diagnostics", diagnostics.topic()}};
    node = std::make_unique<Node>(::ros::NodeHandle(name_space, remapped), ::ros::NodeHandle(node_name), node_name);
  }
  /// Starts it and waits until it has reported the state of `subject`.
  ::testing::AssertionResult starts(const std::string& subject) {
    start();
    return reports_on(subject);
  }
  ::testing::AssertionResult starts() { return starts(camera); }
  /// Expects that it cannot start and returns why.
  std::string refusal() {
    try {
      start();
    } catch (const std::exception& error) {
      return error.what();
    }
    ADD_FAILURE() << "the node started";
    return "";
  }

  std::unique_ptr<Node> node;
};

class TrkToRosTest : public NodeTest<nodes::TrkToRos> {
 protected:
  TrkToRosTest() : NodeTest("trk_to_ros") {}
};

class RosToTrkTest : public NodeTest<nodes::RosToTrk> {
 protected:
  RosToTrkTest() : NodeTest("ros_to_trk") {}

  void set_sinks(const std::vector<std::string>& urls) { set("sinks", urls); }
};

/// A source on a port that the kernel picks. Diagnostics contain which.
inline const std::string any_udp_port = "udp://127.0.0.1:0";

}  // namespace trk_bridge::test
