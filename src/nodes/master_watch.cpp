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
constexpr std::chrono::seconds patience{2};  // with an answer
constexpr double slice = 0.1;                // s, after which it sees that it is to stop

/// One question, asked without blocking: ros::master::execute() waits for ever for a master that has hung.
class Question : public XmlRpc::XmlRpcClient {
 public:
  Question() : XmlRpcClient(::ros::master::getHost().c_str(), static_cast<int>(::ros::master::getPort()), "/") {}

  bool begin() {
    XmlRpc::XmlRpcValue request;
    request[0] = ::ros::this_node::getName();
    request[1] = ::ros::this_node::getName();
    return executeNonBlock("lookupNode", request);
  }
  /// Whether it is over; to be called again until then.
  bool work() {
    _disp.work(slice);
    return over_;
  }
  /// The master's answer once it is over; invalid where there is none.
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
  Question question;
  if (!question.begin()) return std::nullopt;
  const auto end = Clock::now() + patience;
  while (!question.work()) {
    if (stopping_ || Clock::now() > end) return std::nullopt;
  }
  auto answer = question.answer();
  if (answer.getType() != XmlRpc::XmlRpcValue::TypeArray || answer.size() < 3) return std::nullopt;
  // A node of this name that is not this one has taken its place.
  return answer[0] == XmlRpc::XmlRpcValue(1) &&
         answer[2] == XmlRpc::XmlRpcValue(::ros::XMLRPCManager::instance()->getServerURI());
}

}  // namespace trk_bridge::nodes
