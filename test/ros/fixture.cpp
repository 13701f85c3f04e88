#include "fixture.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <utility>

#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>

namespace trk_bridge::test {

bool eventually(const std::function<bool()>& condition, std::chrono::nanoseconds within) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + within;
  while (!condition()) {
    if (Clock::now() > end) return false;
    ::ros::getGlobalCallbackQueue()->callAvailable(::ros::WallDuration(0.005));
  }
  return true;
}

bool is_served(const ::ros::Subscriber& subscriber, const std::string& publisher) {
  XmlRpc::XmlRpcValue request, response, uri;
  request[0] = ::ros::this_node::getName();
  request[1] = publisher;
  std::string host;
  std::uint32_t port = 0;
  if (!::ros::master::execute("lookupNode", request, response, uri, /*wait_for_master=*/false)) return false;
  if (!::ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcClient node(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue name, answer;
  name[0] = ::ros::this_node::getName();
  if (!node.execute("getBusInfo", name, answer) || node.isFault()) return false;
  XmlRpc::XmlRpcValue& connections = answer[2];
  for (int i = 0; i < connections.size(); ++i) {
    XmlRpc::XmlRpcValue& connection = connections[i];
    const std::string to = connection[1], direction = connection[2], topic = connection[4];
    if (to == ::ros::this_node::getName() && direction == "o" && topic == subscriber.getTopic()) return true;
  }
  return false;
}

bool is_advertised(const std::string& topic) {
  ::ros::master::V_TopicInfo topics;
  if (!::ros::master::getTopics(topics)) throw std::runtime_error("the master does not tell its topics");
  return std::any_of(topics.begin(), topics.end(),
                     [&topic](const auto& advertised) { return advertised.name == topic; });
}

TransformRecorder::TransformRecorder(const std::string& topic, std::string child) {
  subscriber_ = ::ros::NodeHandle().subscribe<tf2_msgs::TFMessage>(
      topic, 10000, [this, child = std::move(child)](const tf2_msgs::TFMessageConstPtr& message) {
        for (const auto& transform : message->transforms) {
          if (transform.child_frame_id == child) transforms.push_back(transform);
        }
      });
}

DiagnosticsRecorder::DiagnosticsRecorder() { subscribe(); }

void DiagnosticsRecorder::subscribe() {
  subscriber_.shutdown();
  subscriber_ = ::ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", 1000, [this](const diagnostic_msgs::DiagnosticArrayConstPtr& message) {
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

::testing::AssertionResult DiagnosticsRecorder::tells(const std::string& name, int level, const std::string& text) {
  const auto met = [&] {
    const auto* status = find(name);
    return status != nullptr && status->level == level && status->message.find(text) != std::string::npos;
  };
  if (eventually(met)) return ::testing::AssertionSuccess();
  const auto* status = find(name);
  return ::testing::AssertionFailure() << name << " tells "
                                       << (status == nullptr ? "nothing"
                                                             : std::to_string(status->level) + " " + status->message)
                                       << ", not " << level << " " << text;
}

std::string udp_url(std::uint16_t port) { return "udp://127.0.0.1:" + std::to_string(port); }

NodeTest::NodeTest(const std::string& of_program) : program_path(of_program) {
  static std::atomic<int> made{0};
  camera = "camera" + std::to_string(++made);
  name_space = "/" + camera;
  node_name = name_space + program_path.substr(program_path.find_last_of('/'));
  set("diagnostic_period", 0.1);
}

void NodeTest::start() {
  node = std::make_unique<Program>(std::vector<std::string>{program_path, "__ns:=" + name_space});
}

::testing::AssertionResult NodeTest::starts(const std::string& told_of) {
  start();
  // Values come once its readers have been made; what was told before is "Node starting up".
  const auto told = [&] {
    const auto* status = diagnostics.find(status_name(told_of));
    return status != nullptr && !status->values.empty();
  };
  // The master's news of nodes that come and go may overtake one another, and a subscriber that heard the older one
  // last stays without the new node.
  constexpr int attempts = 4;
  for (int i = 0; i < attempts; ++i) {
    if (eventually(told, deadline / 2)) return ::testing::AssertionSuccess();
    diagnostics.subscribe();
  }
  node->signal(SIGKILL);
  return ::testing::AssertionFailure() << "the node did not start: " << node->rest_of_err();
}

std::string NodeTest::refusal() {
  start();
  const std::string said = node->rest_of_err();
  EXPECT_EQ(node->wait(), 1);
  return said;
}

std::chrono::nanoseconds NodeTest::interrupted() {
  const auto begin = std::chrono::steady_clock::now();
  node->signal(SIGINT);
  (void)node->rest_of_err();
  EXPECT_EQ(node->wait(), 0);
  return std::chrono::steady_clock::now() - begin;
}

}  // namespace trk_bridge::test
