#include "fixture.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include <ros/callback_queue.h>

#include "trk_bridge/wire/format.h"

extern char** environ;

namespace trk_bridge::test {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

}  // namespace

bool eventually(const std::function<bool()>& condition, std::chrono::nanoseconds within) {
  const auto end = Clock::now() + within;
  while (!condition()) {
    if (Clock::now() > end) return false;
    ::ros::getGlobalCallbackQueue()->callAvailable(::ros::WallDuration(0.005));
  }
  return true;
}

Process::Process(const std::string& program, const std::vector<std::string>& arguments) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int error = ::posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  stderr_ = ends[0];
  ::fcntl(stderr_, F_SETFL, O_NONBLOCK);
  if (error != 0) {
    ::close(stderr_);
    throw std::system_error(error, std::generic_category(), program);
  }
}

Process::~Process() {
  if (running()) {
    ::kill(pid_, SIGKILL);
    (void)wait();
  }
  ::close(stderr_);
}

void Process::signal(int number) {
  if (running()) ::kill(pid_, number);
}

bool Process::running() {
  if (status_) return false;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return false;
}

std::optional<int> Process::wait(std::chrono::nanoseconds within) {
  const auto end = Clock::now() + within;
  while (running()) {
    if (Clock::now() > end) return std::nullopt;
    // Its standard error closes when it ends.
    pollfd closed{stderr_, POLLIN, 0};
    ::poll(&closed, 1, 10);
    (void)said();
  }
  (void)said();
  return status_;
}

std::string Process::said() {
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(stderr_, buffer, sizeof buffer)) > 0;)
    said_.append(buffer, static_cast<std::size_t>(n));
  return said_;
}

TransformRecorder::TransformRecorder(const std::string& topic, std::string child) {
  subscriber_ = ::ros::NodeHandle().subscribe<tf2_msgs::TFMessage>(
      topic, 10000, [this, child = std::move(child)](const tf2_msgs::TFMessageConstPtr& message) {
        for (const auto& transform : message->transforms) {
          if (transform.child_frame_id == child) transforms.push_back(transform);
        }
      });
}

DiagnosticsRecorder::DiagnosticsRecorder() {
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

Tracker::Tracker(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const auto address = loopback(port);
  if (socket_ < 0 || ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    fail("socket");
}

Tracker::~Tracker() { ::close(socket_); }

void Tracker::send_bytes(std::string_view datagram) {
  if (::send(socket_, datagram.data(), datagram.size(), 0) != static_cast<ssize_t>(datagram.size())) fail("send");
}

std::uint16_t free_udp_port() {
  const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  auto address = loopback(0);
  socklen_t size = sizeof address;
  if (probe < 0 || ::bind(probe, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      ::getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    fail("no free port");
  }
  ::close(probe);
  return ntohs(address.sin_port);
}

std::string udp_url(std::uint16_t port) { return "udp://127.0.0.1:" + std::to_string(port); }

int free_slot() {
  constexpr std::string_view names = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  for (std::size_t slot = names.size(); slot-- > 0;) {
    const std::string path = std::string("/tmp/dmc_tracking_buffer.") + names[slot];
    if (::access(path.c_str(), F_OK) != 0) return static_cast<int>(slot);
  }
  throw std::runtime_error("every slot of shared memory is in use");
}

wire::CameraConstants some_constants(std::uint32_t id) { return {id, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39}; }

wire::CameraParams some_params(std::uint64_t counter, std::uint32_t id) {
  wire::CameraParams p;
  p.id = id;
  p.format = wire::euler;
  p.euler = {1, 2, 3, 30, -5, 0};
  p.fov = 10;
  p.counter = counter;
  return p;
}

NodeTest::NodeTest() {
  static std::atomic<int> made{0};
  camera = "camera" + std::to_string(++made);
  name_space = "/" + camera;
  node_name = name_space + "/trk_to_ros";
  set("diagnostic_period", 0.1);
}

void NodeTest::start() {
  node = std::make_unique<Process>(TRK_TO_ROS, std::vector<std::string>{"__ns:=" + name_space});
}

::testing::AssertionResult NodeTest::starts(const std::string& told_of) {
  start();
  // Values come once its readers have been made; what was told before is "Node starting up".
  const auto told = [&] {
    const auto* status = diagnostics.find(status_name(told_of));
    return !node->running() || (status != nullptr && !status->values.empty());
  };
  if (eventually(told) && node->running()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "the node did not start: " << node->said();
}

}  // namespace trk_bridge::test
