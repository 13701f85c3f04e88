// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "master_watch.h"

#include <string>

#include <ros/master.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include "base/clock.h"

namespace trk_bridge::nodes {
namespace {

using bridge::MasterState;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds period{5};
constexpr std::chrono::seconds patience{2};  // timeout of an answer
constexpr double slice = 0.1;                // s, interval at which it checks whether to stop

/// One request that does not block: ros::master::execute() would wait forever for a master that hangs.
class Request : public XmlRpc::XmlRpcClient {
 public:
  Request() : XmlRpcClient(::ros::master::getHost().c_str(), static_cast<int>(::ros::master::getPort()), "/") {}

  bool begin() {
    XmlRpc::XmlRpcValue request;
    request[0] = ::ros::this_node::getName();
    request[1] = ::ros::this_node::getName();
    return executeNonBlock("lookupNode", request);
  }
  /// Call repeatedly until it returns true: the request is finished.
  bool work() {
    _disp.work(slice);
    return over_;
  }
  /// The answer of the master after the end of the request; invalid if there is none.
  XmlRpc::XmlRpcValue answer() {
    XmlRpc::XmlRpcValue given;
    executeCheckDone(given);
    return given;
  }

  unsigned handleEvent(unsigned event) override {
    const unsigned wanted = XmlRpcClient::handleEvent(event);
    over_ = wanted == 0;
    return wanted;
  }

 private:
  bool over_ = false;
};

}  // namespace

MasterWatch::MasterWatch() : thread_([this] { run(); }) {}

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  stop_.notify_one();
  thread_.join();
}

void MasterWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopping_ && state_ != MasterState::forgot) {
    lock.unlock();
    const auto known = ask();
    if (known) answered_ = base::steady_now();
    state_ = !known ? MasterState::silent : *known ? MasterState::knows_node : MasterState::forgot;
    lock.lock();
    stop_.wait_for(lock, period, [this] { return stopping_.load(); });
  }
}

std::optional<bool> MasterWatch::ask() {
  Request request;
  if (!request.begin()) return std::nullopt;
  const auto end = Clock::now() + patience;
  while (!request.work()) {
    if (stopping_ || Clock::now() > end) return std::nullopt;
  }
  auto answer = request.answer();
  if (answer.getType() != XmlRpc::XmlRpcValue::TypeArray || answer.size() < 3) return std::nullopt;
  // Another node with the same name may have replaced this one.
  return answer[0] == XmlRpc::XmlRpcValue(1) &&
         answer[2] == XmlRpc::XmlRpcValue(::ros::XMLRPCManager::instance()->getServerURI());
}

}  // namespace trk_bridge::nodes
