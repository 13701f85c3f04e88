// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "fixture.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

#include <ros/callback_queue.h>
#include <ros/master.h>

namespace trk_bridge::test {
namespace {

std::string next_name() {
  static std::atomic<int> made{0};
  return "camera" + std::to_string(++made);
}

}  // namespace

bool eventually(const std::function<bool()>& condition, std::chrono::nanoseconds within) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + within;
  while (!condition()) {
    if (Clock::now() > end) return false;
    ::ros::getGlobalCallbackQueue()->callAvailable(::ros::WallDuration(0.005));
  }
  return true;
}

bool is_advertised(const std::string& topic) {
  ::ros::master::V_TopicInfo topics;
  if (!::ros::master::getTopics(topics)) throw std::runtime_error("the master does not return its topics");
  return std::any_of(topics.begin(), topics.end(),
                     [&topic](const auto& advertised) { return advertised.name == topic; });
}

bool LogRecorder::has(const std::string& text) const {
  return std::any_of(log_.messages.begin(), log_.messages.end(),
                     [&text](const rosgraph_msgs::Log& line) { return line.msg.find(text) != std::string::npos; });
}

TransformRecorder::TransformRecorder(const std::string& topic, std::string child) {
  subscriber_ = ::ros::NodeHandle().subscribe<tf2_msgs::TFMessage>(
      topic, 10000, [this, child = std::move(child)](const tf2_msgs::TFMessageConstPtr& message) {
        for (const auto& transform : message->transforms) {
          if (transform.child_frame_id == child) transforms.push_back(transform);
        }
      });
}

DiagnosticsRecorder::DiagnosticsRecorder(const std::string& topic) {
  subscriber_ = ::ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>(
      topic, 1000, [this](const diagnostic_msgs::DiagnosticArrayConstPtr& message) {
        for (const auto& status : message->status) newest_[status.name] = status;
      });
}

const diagnostic_msgs::DiagnosticStatus* DiagnosticsRecorder::find(const std::string& name) const {
  const auto found = newest_.find(name);
  return found == newest_.end() ? nullptr : &found->second;
}

std::string DiagnosticsRecorder::value(const std::string& name, const std::string& key) const {
  const auto* status = find(name);
  if (status == nullptr) return "";
  for (const auto& pair : status->values) {
    if (pair.key == key) return pair.value;
  }
  return "";
}

::testing::AssertionResult DiagnosticsRecorder::becomes(const std::string& name, const std::string& key,
                                                        const std::string& expected) {
  if (eventually([&] { return value(name, key) == expected; })) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << name << ": " << key << " is '" << value(name, key) << "', not '" << expected
                                       << "'";
}

::testing::AssertionResult DiagnosticsRecorder::reports(const std::string& name, int level, const std::string& text) {
  const auto met = [&] {
    const auto* status = find(name);
    return status != nullptr && status->level == level && status->message.find(text) != std::string::npos;
  };
  if (eventually(met)) return ::testing::AssertionSuccess();
  const auto* status = find(name);
  return ::testing::AssertionFailure() << name << " reports "
                                       << (status == nullptr ? "nothing"
                                                             : std::to_string(status->level) + " " + status->message)
                                       << ", not " << level << " " << text;
}

CameraTest::CameraTest(const std::string& node)
    : camera(next_name()),
      name_space("/" + camera),
      node_name(name_space + "/" + node),
      diagnostics(name_space + "/diagnostics") {
  set("diagnostic_period", 0.1);
}

::testing::AssertionResult CameraTest::reports_on(const std::string& subject) {
  const std::string name = status_name(subject);
  // Values exist after its threads have started; before that there is only "Node starting up".
  const auto reported = [&] {
    const auto* status = diagnostics.find(name);
    return status != nullptr && !status->values.empty();
  };
  if (eventually(reported)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "no diagnostics of " << name;
}

std::uint16_t CameraTest::port(const std::string& of_camera) const {
  const auto* status = diagnostics.find(status_name(of_camera));
  return udp_port_in(status == nullptr ? "" : status->hardware_id);
}

}  // namespace trk_bridge::test
