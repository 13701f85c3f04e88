// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures the time of a set from a datagram to subscribers, or from a topic to a datagram: through a node that is
// already running, or through a nodelet that this program loads into its own manager, together with the subscriber:
//   latency in|out [--nodelet ours|floor] --port PORT [--rate HZ] [--seconds S]
// Prints one line for each topic: name, median, 99th percentile, largest (us), count.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraConstants.h>
#include <CLI/CLI.hpp>

#include "base/clock.h"
#include "floor_relay.h"
#include "nodes/node.h"
#include "nodes/ros_to_trk.h"
#include "nodes/trk_to_ros.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bench {
namespace {

using std::chrono::milliseconds;

struct Options {
  std::string direction, nodelet;
  int port = 0;
  double rate = 50, seconds = 10;
};

/// The latency of each set. Sets are identified by their order: none may be lost.
class Times {
 public:
  Times(std::string name, std::size_t count, const std::vector<std::int64_t>& sent)
      : name_(std::move(name)), sent_(sent) {
    took_.reserve(count);
  }
  void arrived() {
    const std::int64_t now = base::steady_now();
    if (took_.size() < sent_.size()) took_.push_back(now - sent_[took_.size()]);
    count_ = took_.size();
  }
  std::size_t count() const { return count_; }

  void print() {
    std::sort(took_.begin(), took_.end());
    const auto at = [this](double part) {
      return static_cast<double>(took_[static_cast<std::size_t>(part * static_cast<double>(took_.size() - 1))]) / 1e3;
    };
    std::printf("%s,%.1f,%.1f,%.1f,%zu\n", name_.c_str(), at(0.5), at(0.99), at(1), took_.size());
  }

 private:
  std::string name_;
  const std::vector<std::int64_t>& sent_;
  std::vector<std::int64_t> took_;
  std::atomic<std::size_t> count_{0};
};

wire::CameraConstants constants() {
  wire::CameraConstants c;
  c.image_width = 1920;
  c.image_height = 1080;
  c.chip_width = c.fake_chip_width = 9.59;
  c.chip_height = c.fake_chip_height = 5.39;
  return c;
}

/// A camera that pans and zooms, so that the lens must be fitted for every set.
wire::CameraParams params(std::uint64_t counter) {
  const double turn = static_cast<double>(counter % 1000) / 100;
  wire::CameraParams p;
  p.format = wire::euler | wire::field_of_view;
  p.euler = {1.2345678901, -2.5, 1.75, 30 + turn, -5.125, 0.25};
  p.fov = 42.123456789 + turn;
  p.k1 = -0.00123456789;
  p.focdist = 4.5;
  p.counter = counter;
  return p;
}

template <typename Record>
void send(const LoopbackSocket& socket, const Record& record, int port) {
  wire::Buffer buffer;
  const auto bytes = wire::encode(record, {}, buffer);
  socket.send(bytes->data(), bytes->size(), port);
}

/// Calls `act` with 0, 1, ... at the rate, then waits for the last to arrive.
void at_rate(double rate, std::size_t count, const std::function<void(std::size_t)>& act) {
  auto due = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < count; ++i) {
    due += std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate));
    std::this_thread::sleep_until(due);
    act(i);
  }
  std::this_thread::sleep_for(milliseconds(500));
}

/// One second in which everything happens that happens only once. Counters continue in send_all().
constexpr std::uint64_t before_measuring = 1'000'000;
void warm_up(const Options& options, const std::function<void(std::uint64_t)>& send_one) {
  const auto count = static_cast<std::size_t>(options.rate);
  at_rate(options.rate, count, [&](std::size_t i) { send_one(before_measuring - count + i); });
}

/// Calls `send_one` with a counter at the rate, and stores the times in `sent`.
void send_all(const Options& options, std::vector<std::int64_t>& sent,
              const std::function<void(std::uint64_t)>& send_one, const std::vector<Times*>& times) {
  at_rate(options.rate, sent.size(), [&](std::size_t i) {
    sent[i] = base::steady_now();
    send_one(before_measuring + i);
  });
  for (auto* one : times) {
    if (one->count() != sent.size()) {
      throw std::runtime_error(std::to_string(one->count()) + " of " + std::to_string(sent.size()) + " arrived");
    }
    one->print();
  }
}

void wait_for(const char* what, const std::function<bool()>& condition) {
  const auto begin = base::steady_now();
  while (!condition()) {
    if (base::steady_now() - begin > 20'000'000'000) throw std::runtime_error(std::string("no ") + what);
    std::this_thread::sleep_for(milliseconds(10));
  }
}

void measure_in(const Options& options, ::ros::NodeHandle node) {
  std::vector<std::int64_t> sent(static_cast<std::size_t>(options.rate * options.seconds));
  Times params_times("params", sent.size(), sent), info_times("camera_info", sent.size(), sent),
      tf_times("tf", sent.size(), sent);
  std::atomic<bool> is_counting{false};
  const auto subscribe = [&](auto example, const char* topic, Times& times) {
    using Message = decltype(example);
    return node.subscribe<Message>(
        topic, 1000,
        [&](const boost::shared_ptr<const Message>&) {
          if (is_counting) times.arrived();
        },
        ::ros::VoidConstPtr(), ::ros::TransportHints().tcpNoDelay());
  };
  const auto params_topic = subscribe(trk_bridge::CameraParams(), "params", params_times);
  const auto info_topic = subscribe(sensor_msgs::CameraInfo(), "camera_info", info_times);
  const auto tf_topic = subscribe(tf2_msgs::TFMessage(), "/tf", tf_times);
  for (const auto* topic : {&params_topic, &info_topic, &tf_topic}) {
    wait_for("publisher", [&] { return topic->getNumPublishers() == 1; });
  }
  const LoopbackSocket socket(0);
  send(socket, constants(), options.port);
  const auto send_one = [&](std::uint64_t counter) { send(socket, params(counter), options.port); };
  warm_up(options, send_one);
  is_counting = true;
  send_all(options, sent, send_one, {&params_times, &info_times, &tf_times});
}

void measure_out(const Options& options, ::ros::NodeHandle node, const LoopbackSocket& socket) {
  std::vector<std::int64_t> sent(static_cast<std::size_t>(options.rate * options.seconds));
  Times times("datagram", sent.size(), sent);
  std::atomic<bool> is_counting{false};
  std::thread receiver([&] {
    wire::Buffer buffer;
    wire::LayoutDetector detector;
    while (const auto size = socket.receive(buffer.data(), buffer.size())) {
      const bool is_params = buffer[6] == 'P';
      if (is_counting && is_params) times.arrived();
    }
  });
  const auto finish = [&] {
    socket.close();
    receiver.join();
  };
  try {
    auto constants_topic = node.advertise<trk_bridge::CameraConstants>("constants", 1, /*latch=*/true);
    trk_bridge::CameraConstants message;
    ros1::to_msg(constants(), message);
    constants_topic.publish(message);
    auto topic = node.advertise<trk_bridge::CameraParams>("params", 100);
    wait_for("subscriber", [&] { return topic.getNumSubscribers() == 1; });
    const auto publish = [&](std::uint64_t counter) {
      const auto params_message = boost::make_shared<trk_bridge::CameraParams>();
      ros1::to_msg(params(counter), *params_message);
      params_message->header.stamp = ::ros::Time::now();
      topic.publish(params_message);
    };
    warm_up(options, publish);
    is_counting = true;
    send_all(options, sent, publish, {&times});
  } catch (...) {
    finish();
    throw;
  }
  finish();
}

/// A second nodelet in the manager, which provides a node handle beside the measured one.
class Beside : public nodelet::Nodelet {
 public:
  void onInit() override {}
  ::ros::NodeHandle node() const { return getNodeHandle(); }
};

boost::shared_ptr<nodelet::Nodelet> make(const std::string& kind) {
  using nodes::RunningNodelet;
  if (kind == "in ours") return boost::make_shared<RunningNodelet<nodes::TrkToRos>>();
  if (kind == "in floor") return boost::make_shared<RunningNodelet<FloorIn>>();
  if (kind == "out ours") return boost::make_shared<RunningNodelet<nodes::RosToTrk>>();
  return boost::make_shared<RunningNodelet<FloorOut>>();
}

void run(Options options) {
  const bool is_in = options.direction == "in";
  const LoopbackSocket socket(is_in ? 0 : options.port);
  if (options.nodelet.empty()) {
    ::ros::AsyncSpinner spinner(1);
    spinner.start();
    is_in ? measure_in(options, ::ros::NodeHandle()) : measure_out(options, ::ros::NodeHandle(), socket);
    return;
  }
  const std::string endpoint = "udp://127.0.0.1:" + std::to_string(options.port);
  ::ros::param::del("/measured");
  if (options.nodelet == "floor") {
    ::ros::param::set("/measured/port", options.port);
  } else if (is_in) {
    ::ros::param::set("/measured/source", endpoint);
  } else {
    ::ros::param::set("/measured/sinks", std::vector<std::string>{endpoint});
  }
  const auto beside = boost::make_shared<Beside>();
  nodelet::Loader loader([&](const std::string& kind) -> boost::shared_ptr<nodelet::Nodelet> {
    return kind == "beside" ? beside : make(kind);
  });
  ::ros::AsyncSpinner spinner(1);
  spinner.start();
  if (!loader.load("/beside", "beside", {}, {}) ||
      !loader.load("/measured", options.direction + " " + options.nodelet, {}, {})) {
    throw std::runtime_error("the nodelets cannot be loaded");
  }
  is_in ? measure_in(options, beside->node()) : measure_out(options, beside->node(), socket);
}

}  // namespace
}  // namespace trk_bridge::bench

int main(int argc, char** argv) {
  using trk_bridge::bench::Options;
  ::ros::init(argc, argv, "latency", ::ros::init_options::AnonymousName);
  Options options;
  CLI::App app("Measures the latency of a set through a node or a nodelet.");
  app.add_option("direction", options.direction)->required()->check(CLI::IsMember({"in", "out"}));
  app.add_option("--nodelet", options.nodelet)->check(CLI::IsMember({"ours", "floor"}));
  app.add_option("--port", options.port)->required();
  app.add_option("--rate", options.rate)->check(CLI::PositiveNumber);
  app.add_option("--seconds", options.seconds)->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    trk_bridge::bench::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "latency: %s\n", error.what());
    return 1;
  }
  return 0;
}
