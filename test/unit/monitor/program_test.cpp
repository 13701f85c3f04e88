// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk monitor`, run like a user does: on a terminal, and into a pipe.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "cli/exit_code.h"
#include "program.h"
#include "temporary_directory.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "udp.h"
#include "vt100.h"

namespace trk_bridge::monitor::program_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using Clock = std::chrono::steady_clock;

/// `trk monitor` of a separate port on a terminal of 80 by 24.
class MonitorOnATerminal {
 public:
  explicit MonitorOnATerminal(const std::string& type = "vt100", const char* no_color = nullptr,
                              std::vector<std::string> options = {}, const std::string& folder = ".")
      : options_(std::move(options)), folder_(folder) {
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) throw std::runtime_error("no terminal");
    const std::string name = ::ptsname(master_);
    // Kept open, so that its settings outlive the program.
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

  /// Reads the output until the screen is as expected; calls `meanwhile` before each read. False if that never happens.
  bool shows(
      const std::function<bool(const std::string&)>& wanted, const std::function<void()>& meanwhile = [] {}) {
    const auto end = Clock::now() + test::deadline;
    for (;;) {
      // Only complete drawings.
      while (read_some(5)) {
      }
      if (wanted(screen.text())) return true;
      if (Clock::now() > end) return false;
      meanwhile();
      read_some();
    }
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
  std::string written;  ///< all output, with its sequences

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
    std::vector<const char*> words{TRK_TOOL, "monitor", "udp://127.0.0.1:0"};
    for (const auto& option : options_) words.push_back(option.c_str());
    words.push_back(nullptr);
    if (::chdir(folder_.c_str()) == 0) ::execv(TRK_TOOL, const_cast<char* const*>(words.data()));
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

  /// The output within the time.
  bool read_some(int milliseconds = 50) {
    pollfd watched{master_, POLLIN, 0};
    if (::poll(&watched, 1, milliseconds) != 1) return false;
    char bytes[4096];
    const ssize_t got = ::read(master_, bytes, sizeof bytes);
    if (got <= 0) return false;
    written.append(bytes, static_cast<std::size_t>(got));
    screen.write({bytes, static_cast<std::size_t>(got)});
    return true;
  }

  const std::vector<std::string> options_;
  const std::string folder_;
  int master_ = -1, slave_ = -1;
  termios before_{};
  pid_t pid_ = -1;
};

/// Each call sends the next parameters of camera 7.
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

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(TrkMonitor, ShowsRecordsInTerminalsOfAnySize) {
  MonitorOnATerminal monitor;
  Tracker tracker(monitor.port());
  EXPECT_TRUE(monitor.shows("! waiting for udp port")) << monitor.screen.text();
  tracker.send("no record");
  tracker();
  ASSERT_TRUE(monitor.shows("no constants received")) << monitor.screen.text();
  tracker.send(test::datagram(test::constants(720, 7)));
  const auto is_complete = [](const std::string& text) {
    return has(text, "image 720 x 576 px") && has(text, "p99 ") && has(text, "pan (deg), last 10 s");
  };
  ASSERT_TRUE(monitor.shows(is_complete, std::ref(tracker))) << monitor.screen.text();
  EXPECT_THAT(
      monitor.screen.text(),
      AllOf(StartsWith("trk monitor  receiving  records "), HasSubstr("malformed 1"), HasSubstr("from 127.0.0.1:"),
            HasSubstr("\nid 7  "), HasSubstr("\n  x       1.5000 m   y      -2.0000 m   z       1.7500 m\n"),
            HasSubstr("\n  pan     30.000 deg tilt    -5.000 deg roll     0.250 deg\n"), HasSubstr("lens    42.000 mm"),
            HasSubstr("lost         0     out of order 0"), HasSubstr("ASCII: euler studio_z_up image_distance"),
            HasSubstr("intervals, last 10 s"), HasSubstr("\n?: help  q: quit  p: pause")));

  monitor.resize(40, 10);
  const auto is_small = [](const std::string& text) {
    return has(text, "\nhidden: ") && !has(text, "ASCII") && has(text, "x       1.5000 m   y      -2.0000 m\n");
  };
  ASSERT_TRUE(monitor.shows(is_small, std::ref(tracker))) << monitor.screen.text();

  monitor.resize(132, 43);
  const auto is_large = [&](const std::string& text) {
    return is_complete(text) && has(text, "tilt (deg), last 10 s") && !has(text, "hidden");
  };
  ASSERT_TRUE(monitor.shows(is_large, std::ref(tracker))) << monitor.screen.text();
  EXPECT_THAT(monitor.screen.text(), HasSubstr("z       1.7500 m   pan     30.000 deg tilt    -5.000 deg roll "));

  monitor.resize(80, 24);
  ASSERT_TRUE(monitor.shows(is_complete, std::ref(tracker))) << monitor.screen.text();
  monitor.type('q');
  EXPECT_EQ(monitor.wait(), 0);
  EXPECT_TRUE(monitor.is_as_before());
  EXPECT_THAT(monitor.written, HasSubstr("trk: id 7 from 127.0.0.1:"));
}

TEST(TrkMonitor, HasKeys) {
  MonitorOnATerminal monitor;
  const auto port = monitor.port();
  Tracker tracker(port);
  const auto second = [&] { tracker.send(test::datagram(test::params(1, 9))); };
  tracker.send(test::datagram(test::constants(720, 7)));
  tracker();
  second();
  ASSERT_TRUE(monitor.shows("> id 7")) << monitor.screen.text();
  monitor.type('n');
  ASSERT_TRUE(monitor.shows("> id 9")) << monitor.screen.text();
  monitor.type('N');
  ASSERT_TRUE(monitor.shows("> id 7")) << monitor.screen.text();
  monitor.type('v');
  monitor.type('t');
  const auto plots_tilt = [](const std::string& text) { return has(text, "tilt (deg), last 30 s"); };
  ASSERT_TRUE(monitor.shows(plots_tilt, std::ref(tracker))) << monitor.screen.text();
  monitor.type('V');
  ASSERT_TRUE(
      monitor.shows([](const std::string& text) { return has(text, "pan (deg), last 30 s"); }, std::ref(tracker)));

  monitor.type('?');
  ASSERT_TRUE(monitor.shows("p  pause          r  reset")) << monitor.screen.text();
  monitor.type('p');
  ASSERT_TRUE(monitor.shows([](const std::string& text) { return has(text, "trk monitor  receiving"); }))
      << "any key returns, and does nothing else";

  monitor.type('p');
  ASSERT_TRUE(monitor.shows("PAUSED")) << monitor.screen.text();
  const std::string paused = monitor.screen.text();
  for (int i = 0; i < 10; ++i) tracker();
  monitor.type('x');
  ASSERT_TRUE(monitor.shows("unknown key")) << monitor.screen.text();
  const auto counter = paused.substr(paused.find("counter "), 15);
  EXPECT_THAT(monitor.screen.text(), HasSubstr(counter)) << "paused";
  monitor.type('p');
  ASSERT_TRUE(monitor.shows([&](const std::string& text) { return !has(text, "PAUSED") && !has(text, counter); }))
      << monitor.screen.text();

  monitor.type('r');
  ASSERT_TRUE(monitor.shows("records 0  malformed 0")) << monitor.screen.text();
  monitor.type('q');
  EXPECT_EQ(monitor.wait(), 0);
}

TEST(TrkMonitor, GuidesTheAxisCheck) {
  MonitorOnATerminal monitor;
  const test::PlainSocket socket;
  const auto port = monitor.port();
  auto params = test::params(1, 7);
  const auto send = [&] {
    ++params.counter;
    socket.send(test::datagram(params), "127.0.0.1", port);
  };
  ASSERT_TRUE(monitor.shows([](const std::string& text) { return has(text, "id 7"); }, send));
  monitor.type('a');
  ASSERT_TRUE(monitor.shows([](const std::string& text) { return has(text, "AXIS CHECK 1/6: pan left now"); }, send))
      << monitor.screen.text();
  params.euler.pan -= 20;
  ASSERT_TRUE(monitor.shows(
      [](const std::string& text) { return has(text, "pan left: pan -20.00 deg: WRONG SIGN, pan should grow"); }, send))
      << monitor.screen.text();
  monitor.type(' ');
  ASSERT_TRUE(monitor.shows([](const std::string& text) { return has(text, "AXIS CHECK 2/6: tilt up now"); }, send));
  params.euler.tilt += 10;
  ASSERT_TRUE(monitor.shows([](const std::string& text) { return has(text, "tilt up: tilt +10.00 deg: right"); }, send))
      << monitor.screen.text();
  monitor.type('a');
  ASSERT_TRUE(monitor.shows([](const std::string& text) { return !has(text, "AXIS CHECK"); }, send));
  monitor.type('q');
  EXPECT_EQ(monitor.wait(), 0);
}

TEST(TrkMonitor, RecordsTheCameraThatIsShown) {
  const test::TemporaryDirectory folder;
  MonitorOnATerminal monitor("vt100", nullptr, {}, folder.path());
  Tracker tracker(monitor.port());
  tracker();
  ASSERT_TRUE(monitor.shows("no constants received"));
  monitor.type('R');
  ASSERT_TRUE(monitor.shows("not recorded: no constants of id 7 received")) << monitor.screen.text();
  tracker.send(test::datagram(test::constants(720, 7)));
  ASSERT_TRUE(monitor.shows("image 720 x 576 px"));
  monitor.type('R');
  ASSERT_TRUE(monitor.shows("recording ")) << monitor.screen.text();
  const auto has_records = [](const std::string& text) {
    return has(text, "recording file take-") && has(text, "records") && !has(text, ", 0 records");
  };
  ASSERT_TRUE(monitor.shows(has_records, std::ref(tracker))) << monitor.screen.text();
  monitor.type('R');
  ASSERT_TRUE(monitor.shows("recorded file take-")) << monitor.screen.text();
  monitor.type('q');
  EXPECT_EQ(monitor.wait(), 0);

  std::vector<std::filesystem::path> takes(std::filesystem::directory_iterator(folder.path()), {});
  ASSERT_EQ(takes.size(), 1U);
  const auto take = endpoints::open_source("file:" + takes.front().string() + "?speed=0");
  transport::Reception reception;
  ASSERT_EQ(take->receive(reception, test::deadline), transport::Event::sample);
  EXPECT_TRUE(std::holds_alternative<wire::CameraConstants>(reception.sample.record));
  ASSERT_EQ(take->receive(reception, test::deadline), transport::Event::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record).id, 7U);
}

TEST(TrkMonitor, AnAlarmRingsAndIsTheExitCode) {
  MonitorOnATerminal monitor("xterm", nullptr, {"--alarm", "loss>1%", "--alarm", "rate<1"});
  const auto written = [&](const std::string& part) {
    return monitor.shows([&](const std::string&) { return has(monitor.written, part); });
  };
  const std::string place = "on 127.0.0.1";
  ASSERT_TRUE(written(place));
  const auto at = monitor.written.rfind("udp port ", monitor.written.find(place)) + 9;
  const test::PlainSocket socket;
  for (const std::uint64_t counter : {1U, 2U, 9U}) {
    socket.send(test::datagram(test::params(counter, 7)), "127.0.0.1",
                static_cast<std::uint16_t>(std::stoi(monitor.written.substr(at))));
  }
  ASSERT_TRUE(written("ALARM loss>1%: id 7: loss 66.67 %")) << monitor.written;
  ASSERT_TRUE(written("\a"));
  monitor.type('q');
  EXPECT_EQ(monitor.wait(), cli::exit_alarm);
}

TEST(TrkMonitor, AnAlarmThatIsNotRaisedIsNotAnError) {
  test::Program quiet({TRK_TOOL, "monitor", "--alarm", "silence>100s", "--seconds", "0.2", "udp://127.0.0.1:0"});
  quiet.rest_of_out();
  quiet.rest_of_err();
  EXPECT_EQ(quiet.wait(), 0);
  test::Program raised({TRK_TOOL, "monitor", "--alarm=silence>0.1s", "--seconds", "0.5", "udp://127.0.0.1:0"});
  EXPECT_THAT(raised.rest_of_out(), HasSubstr("! ALARM silence>0.1s: silence "));
  raised.rest_of_err();
  EXPECT_EQ(raised.wait(), cli::exit_alarm);
  test::Program wrong({TRK_TOOL, "monitor", "--alarm", "los>1%", "udp://127.0.0.1:0"});
  EXPECT_THAT(wrong.rest_of_err(),
              HasSubstr("trk: error: --alarm: \"los>1%\": quantity \"los\": allowed are loss (%), rate (Hz)"));
  wrong.rest_of_out();
  EXPECT_EQ(wrong.wait(), 2);
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

// A warning: with a background, so that it can be read on any.
bool has_colour(const std::string& written) { return has(written, "\x1B[30m\x1B[43m") || has(written, "\x1B[30;43m"); }

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

TEST(TrkMonitor, ATerminalOfUnknownTypeIsAnError) {
  MonitorOnATerminal monitor("no_such_terminal");
  EXPECT_EQ(monitor.wait(), 1);
  EXPECT_TRUE(monitor.is_as_before());
  EXPECT_THAT(monitor.written, HasSubstr("trk: error: TERM='no_such_terminal': unknown type of terminal"));
}

TEST(TrkMonitor, IntoAPipeItIsOneLinePerSecond) {
  test::Program monitor({TRK_TOOL, "monitor", "udp://127.0.0.1:0"});
  const std::string reading = monitor.err_line().value_or("");
  ASSERT_THAT(reading, StartsWith("trk: reading udp port "));
  Tracker tracker(static_cast<std::uint16_t>(std::stoi(reading.substr(reading.find("port ") + 5))));
  tracker();
  std::string findings, line;
  while ((line = monitor.out_line().value_or("the end of Z  id 7")).find("Z  id 7") == std::string::npos) {
    findings += line;
  }
  EXPECT_THAT(findings, HasSubstr("Z  ! id 7: no constants received"));
  EXPECT_THAT(line, AllOf(HasSubstr("counter 1001"), HasSubstr("x 1.5000 m"), Not(HasSubstr("\x1B"))));
  monitor.signal(SIGINT);
  monitor.rest_of_out();
  EXPECT_THAT(monitor.rest_of_err(), HasSubstr("1 accepted"));
  EXPECT_EQ(monitor.wait(), 0);
}

TEST(TrkMonitor, EndsAfterTheTimeGiven) {
  test::Program monitor({TRK_TOOL, "monitor", "--seconds", "0.2", "udp://127.0.0.1:0"});
  // Which finding is reported depends on the traffic of other programs.
  EXPECT_THAT(monitor.rest_of_out(), HasSubstr("Z  trk monitor  waiting  records 0"));
  monitor.rest_of_err();
  EXPECT_EQ(monitor.wait(), 0);
}

TEST(TrkMonitor, AReaderThatClosesThePipeIsNotAnError) {
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

}  // namespace trk_bridge::monitor::program_test
