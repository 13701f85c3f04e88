// `trk monitor` as its user runs it: on a terminal, and into a pipe.
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "program.h"
#include "udp.h"
#include "vt100.h"

namespace trk_bridge::monitor {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using Clock = std::chrono::steady_clock;

/// `trk monitor` of a port of its own on a terminal of 80 by 24.
class MonitorOnATerminal {
 public:
  explicit MonitorOnATerminal(const std::string& type = "vt100", const char* no_color = nullptr) {
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) throw std::runtime_error("no terminal");
    const std::string name = ::ptsname(master_);
    // Held open, so that its settings outlive the program.
    slave_ = ::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    set_size(80, 24);
    before_ = settings();
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("no process");
    if (pid_ == 0) become(type, no_color);
  }
  ~MonitorOnATerminal() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    ::close(slave_);
    ::close(master_);
  }
  MonitorOnATerminal(const MonitorOnATerminal&) = delete;
  MonitorOnATerminal& operator=(const MonitorOnATerminal&) = delete;

  void resize(unsigned short width, unsigned short height) {
    screen.resize(width, height);
    set_size(width, height);
  }
  void type(char key) const { ASSERT_EQ(::write(master_, &key, 1), 1); }
  void signal(int number) const { ::kill(pid_, number); }

  /// Reads what is drawn until the screen is as wanted; `meanwhile` is done every time before. False when it never is.
  bool shows(
      const std::function<bool(const std::string&)>& wanted, const std::function<void()>& meanwhile = [] {}) {
    const auto end = Clock::now() + test::deadline;
    while (!wanted(screen.text())) {
      if (Clock::now() > end) return false;
      meanwhile();
      read_some();
    }
    return true;
  }
  bool shows(const std::string& wanted) {
    return shows([&](const std::string& text) { return text.find(wanted) != std::string::npos; });
  }

  std::uint16_t port() {
    const std::string before = "udp port ", after = " on 127.0.0.1";
    if (!shows(after)) throw std::runtime_error("no port on\n" + screen.text());
    const std::string text = screen.text();
    return static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(before, text.find(after)) + before.size())));
  }

  /// The exit code, or minus the signal that ended it; or none within the deadline.
  std::optional<int> wait() {
    const auto end = Clock::now() + test::deadline;
    while (Clock::now() < end) {
      int status = 0;
      read_some();
      if (::waitpid(pid_, &status, WNOHANG) != pid_) continue;
      pid_ = -1;
      while (read_some()) {
      }
      return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    return std::nullopt;
  }

  bool is_as_before() const {
    const termios now = settings();
    return now.c_iflag == before_.c_iflag && now.c_oflag == before_.c_oflag && now.c_cflag == before_.c_cflag &&
           now.c_lflag == before_.c_lflag && std::equal(std::begin(now.c_cc), std::end(now.c_cc), before_.c_cc);
  }

  test::Vt100 screen{80, 24};
  std::string written;  ///< all of it, with its sequences

 private:
  [[noreturn]] void become(const std::string& type, const char* no_color) const {
    ::setsid();
    ::ioctl(slave_, TIOCSCTTY, 0);
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(slave_, fd);
    ::setenv("TERM", type.c_str(), 1);
    ::unsetenv("NO_COLOR");
    if (no_color != nullptr) ::setenv("NO_COLOR", no_color, 1);
    ::unsetenv("LINES");
    ::unsetenv("COLUMNS");
    ::execl(TRK_TOOL, TRK_TOOL, "monitor", "udp://127.0.0.1:0", nullptr);
    ::_exit(127);
  }

  void set_size(unsigned short width, unsigned short height) const {
    winsize size{};
    size.ws_col = width;
    size.ws_row = height;
    ::ioctl(master_, TIOCSWINSZ, &size);
  }

  termios settings() const {
    termios now{};
    ::tcgetattr(slave_, &now);
    return now;
  }

  /// What comes within a twentieth of a second.
  bool read_some() {
    pollfd watched{master_, POLLIN, 0};
    if (::poll(&watched, 1, 50) != 1) return false;
    char bytes[4096];
    const ssize_t got = ::read(master_, bytes, sizeof bytes);
    if (got <= 0) return false;
    written.append(bytes, static_cast<std::size_t>(got));
    screen.write({bytes, static_cast<std::size_t>(got)});
    return true;
  }

  int master_ = -1, slave_ = -1;
  termios before_{};
  pid_t pid_ = -1;
};

/// Sends one more set of parameters of camera 7 with every call.
class Tracker {
 public:
  explicit Tracker(std::uint16_t port) : port_(port) {}
  void send(const std::string& datagram) const { socket_.send(datagram, "127.0.0.1", port_); }
  void operator()() { send(test::datagram(test::params(++counter_, 7))); }

 private:
  std::uint16_t port_;
  test::PlainSocket socket_;
  std::uint64_t counter_ = 1000;
};

TEST(TrkMonitor, ShowsWhatComesInEightyByTwentyFourAndResized) {
  MonitorOnATerminal monitor;
  Tracker tracker(monitor.port());
  EXPECT_TRUE(monitor.shows("trk monitor  waiting for udp port"));
  tracker.send("no record");
  tracker();
  ASSERT_TRUE(monitor.shows("NO CONSTANTS have come")) << monitor.screen.text();
  tracker.send(test::datagram(test::constants(720, 7)));
  const auto is_complete = [](const std::string& text) {
    return text.find("image 720 x 576 px") != std::string::npos && text.find("p99 ") != std::string::npos;
  };
  ASSERT_TRUE(monitor.shows(is_complete, std::ref(tracker))) << monitor.screen.text();
  EXPECT_THAT(monitor.screen.text(),
              AllOf(StartsWith("trk monitor  receiving  q: quit\n"), HasSubstr("malformed 1"),
                    HasSubstr("from 127.0.0.1:"), HasSubstr("\nid 7  "),
                    HasSubstr("x   1.5000 y  -2.0000 z   1.7500 m pan   30.000 tilt  -5.000 roll    0.250 deg\n"),
                    HasSubstr("lens 42.000 mm"), HasSubstr("lost 0  out of order 0"),
                    HasSubstr("ASCII: euler studio_z_up image_distance")));

  monitor.resize(40, 10);
  const auto is_small = [](const std::string& text) {
    return text.find("malformed 1\n  udp port ") != std::string::npos && text.find("ASCII") == std::string::npos &&
           text.find("x   1.5000 y  -2.0000 z   1.7500 m\n") != std::string::npos;
  };
  ASSERT_TRUE(monitor.shows(is_small, std::ref(tracker))) << monitor.screen.text();

  monitor.resize(80, 24);
  ASSERT_TRUE(monitor.shows(is_complete, std::ref(tracker))) << monitor.screen.text();
  monitor.type('q');
  EXPECT_EQ(monitor.wait(), 0);
  EXPECT_TRUE(monitor.is_as_before());
  EXPECT_THAT(monitor.written, HasSubstr("trk: id 7 from 127.0.0.1:"));
}

class TrkMonitorEnds : public testing::TestWithParam<int> {};

TEST_P(TrkMonitorEnds, InOrderAtASignal) {
  MonitorOnATerminal monitor("xterm");
  ASSERT_TRUE(monitor.shows([&](const std::string&) { return monitor.written.find("q: quit") != std::string::npos; }))
      << monitor.written;
  EXPECT_FALSE(monitor.is_as_before());
  monitor.signal(GetParam());
  EXPECT_EQ(monitor.wait(), 0);
  EXPECT_TRUE(monitor.is_as_before());
  // Back from the alternate screen, with a cursor.
  EXPECT_THAT(monitor.written, AllOf(HasSubstr("\x1B[?1049l"), HasSubstr("\x1B[?25h")));
  EXPECT_THAT(monitor.written, HasSubstr("trk: received 0"));
}

INSTANTIATE_TEST_SUITE_P(Signals, TrkMonitorEnds, testing::Values(SIGINT, SIGTERM, SIGHUP, SIGQUIT));

bool has_colour(const std::string& written) { return written.find("\x1B[33m") != std::string::npos; }

TEST(TrkMonitor, HasColourUnlessSwitchedOff) {
  for (const char* no_color : {static_cast<const char*>(nullptr), "1"}) {
    MonitorOnATerminal monitor("xterm", no_color);
    // What it waits for is a warning.
    ASSERT_TRUE(monitor.shows([&](const std::string&) { return monitor.written.find("q: quit") != std::string::npos; }))
        << monitor.written;
    monitor.type('q');
    EXPECT_EQ(monitor.wait(), 0);
    EXPECT_EQ(has_colour(monitor.written), no_color == nullptr) << monitor.written;
  }
}

TEST(TrkMonitor, ATerminalOfNoKnownTypeIsAnError) {
  MonitorOnATerminal monitor("no_such_terminal");
  EXPECT_EQ(monitor.wait(), 1);
  EXPECT_TRUE(monitor.is_as_before());
  EXPECT_THAT(monitor.written, HasSubstr("trk: error: TERM='no_such_terminal': no terminal of that type is known"));
}

TEST(TrkMonitor, IntoAPipeItIsALineASecond) {
  test::Program monitor({TRK_TOOL, "monitor", "udp://127.0.0.1:0"});
  const std::string reading = monitor.err_line().value_or("");
  ASSERT_THAT(reading, StartsWith("trk: reading udp port "));
  Tracker tracker(static_cast<std::uint16_t>(std::stoi(reading.substr(reading.find("port ") + 5))));
  tracker();
  std::string line;
  do {
    line = monitor.out_line().value_or("the end");
  } while (line.find("waiting for") != std::string::npos);
  EXPECT_THAT(line, AllOf(HasSubstr("Z  id 7  "), HasSubstr("counter 1001"), HasSubstr("x   1.5000"),
                          HasSubstr("NO CONSTANTS have come"), Not(HasSubstr("\x1B"))));
  monitor.signal(SIGINT);
  monitor.rest_of_out();
  EXPECT_THAT(monitor.rest_of_err(), HasSubstr("1 accepted"));
  EXPECT_EQ(monitor.wait(), 0);
}

TEST(TrkMonitor, EndsAfterTheTimeGiven) {
  test::Program monitor({TRK_TOOL, "monitor", "--seconds", "0.2", "udp://127.0.0.1:0"});
  EXPECT_THAT(monitor.rest_of_out(), HasSubstr("waiting for udp port"));
  monitor.rest_of_err();
  EXPECT_EQ(monitor.wait(), 0);
}

TEST(TrkMonitor, AReaderThatWentAwayIsAnOrdinaryEnd) {
  test::Program monitor({TRK_TOOL, "monitor", "udp://127.0.0.1:0"});
  ASSERT_TRUE(monitor.out_line());
  monitor.close_out();
  monitor.rest_of_err();
  EXPECT_EQ(monitor.wait(), 0);
}

TEST(TrkMonitor, AFullDiskIsAnError) {
  test::Program monitor({"/bin/sh", "-c", "exec " TRK_TOOL " monitor udp://127.0.0.1:0 > /dev/full"});
  EXPECT_THAT(monitor.rest_of_err(), HasSubstr("trk: error: standard output: No space left on device"));
  EXPECT_THAT(monitor.rest_of_out(), IsEmpty());
  EXPECT_EQ(monitor.wait(), 1);
}

}  // namespace
}  // namespace trk_bridge::monitor
