// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Runs a program of the project as its user does: starts it, reads its output, sends signals, waits for its end.
#pragma once

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "deadline.h"

namespace trk_bridge::test {

/// Its standard input is empty. The destructor kills a running program; it gets SIGTERM when the thread that started it
/// ends.
class Program {
 public:
  explicit Program(std::vector<std::string> words) : words_(std::move(words)) {
    int out[2], err[2];
    if (::pipe2(out, O_CLOEXEC) != 0 || ::pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("no process");
    if (pid_ == 0) become(out[1], err[1]);
    ::close(out[1]);
    ::close(err[1]);
    out_.fd = out[0];
    err_.fd = err[0];
  }
  ~Program() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    close_out();
    ::close(err_.fd);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// The next line without its newline; none at the end, or if no line is received within the deadline.
  std::optional<std::string> out_line() { return line(out_); }
  std::optional<std::string> err_line() { return line(err_); }

  /// Everything until the program closes it.
  std::string rest_of_out() { return rest(out_); }
  std::string rest_of_err() { return rest(err_); }

  pid_t pid() const { return pid_; }
  void signal(int number) const { ::kill(pid_, number); }
  /// Like a reader of a pipe that stops reading.
  void close_out() {
    if (out_.fd >= 0) ::close(out_.fd);
    out_.fd = -1;
  }

  /// The exit code, or minus the signal that ended it. To be called once, when both outputs have been read.
  int wait() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  struct Stream {
    int fd = -1;
    std::string text;
  };

  [[noreturn]] void become(int out, int err) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int in = ::open("/dev/null", O_RDONLY);
    ::dup2(in, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    std::vector<char*> arguments;
    for (auto& word : words_) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }

  /// False at the end, or if nothing is received within the deadline.
  static bool more(Stream& stream) {
    pollfd watched{stream.fd, POLLIN, 0};
    if (::poll(&watched, 1, static_cast<int>(std::chrono::milliseconds(deadline).count())) != 1) return false;
    char chunk[4096];
    const ssize_t got = ::read(stream.fd, chunk, sizeof chunk);
    if (got <= 0) return false;
    stream.text.append(chunk, static_cast<std::size_t>(got));
    return true;
  }

  static std::optional<std::string> line(Stream& stream) {
    for (;;) {
      const std::size_t end = stream.text.find('\n');
      if (end != std::string::npos) {
        std::string result = stream.text.substr(0, end);
        stream.text.erase(0, end + 1);
        return result;
      }
      if (!more(stream)) return std::nullopt;
    }
  }

  static std::string rest(Stream& stream) {
    while (more(stream)) {
    }
    return std::move(stream.text);
  }

  std::vector<std::string> words_;
  pid_t pid_ = -1;
  Stream out_, err_;
};

/// The port in "… udp port N …", the next line of its standard error.
inline std::uint16_t port_of(Program& program) {
  const std::string line = program.err_line().value_or("");
  const std::string before = "udp port ";
  const std::size_t at = line.find(before);
  if (at == std::string::npos) throw std::runtime_error("no port in \"" + line + "\"");
  return static_cast<std::uint16_t>(std::stoi(line.substr(at + before.size())));
}

}  // namespace trk_bridge::test
