// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Takes that are played while another program writes them to a FIFO.
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "file/scheme.h"
#include "play_file.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::file::file_fifo_test {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using testing::HasSubstr;
using transport::Event;
using transport::Reception;
using transport::SourceState;
using transport::TransportError;

class PlayFifo : public PlayFile {
 protected:
  PlayFifo() {
    take = (take_of(3), test::read_text(path));
    settings.path = path;
    settings.speed = 0;
    ::unlink(path.c_str());
    if (::mkfifo(path.c_str(), 0600) != 0) throw std::runtime_error("no FIFO");
  }
  /// Like a program that writes and does not exit.
  void write(const std::string& text) {
    if (fd < 0) fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    ASSERT_EQ(::write(fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void close() { ::close(std::exchange(fd, -1)); }
  ~PlayFifo() override {
    if (fd >= 0) ::close(fd);
  }

  SourceSettings settings;
  std::string take;
  int fd = -1;
  Reception r;
};

TEST_F(PlayFifo, LinesArePlayedWhenTheyArrive) {
  const auto source = open_source(settings, 50.0);
  EXPECT_EQ(source->receive(r, 0ns), Event::idle);
  EXPECT_THAT(source->statistics().waiting_for, HasSubstr("nothing written yet"));
  const std::size_t cut = take.size() - 10;
  write(take.substr(0, cut));
  ASSERT_EQ(source->receive(r, -1ns), Event::sample);
  EXPECT_TRUE(is_constants(r));
  for (const std::uint64_t i : {1U, 2U}) {
    ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    EXPECT_EQ(counter(r), i);
  }
  EXPECT_EQ(source->receive(r, 1ms), Event::idle) << "the third is not complete";
  write(take.substr(cut));
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_EQ(counter(r), 3U);
  write("1 2 3");
  close();
  ASSERT_EQ(source->receive(r, -1ns), Event::malformed);
  EXPECT_THAT(describe(r.fault), HasSubstr("line 7 is truncated"));
  EXPECT_EQ(source->receive(r, -1ns), Event::ended);
}

TEST_F(PlayFifo, TheFieldsOfALateWriterArePacedFromItsBeginning) {
  settings.speed = 1;
  const auto source = open_source(settings, 50.0);
  EXPECT_EQ(source->receive(r, 100ms), Event::idle);
  write(take);
  ASSERT_EQ(source->receive(r, -1ns), Event::sample);
  const auto begin = Clock::now();
  for (int i = 0; i < 3; ++i) ASSERT_EQ(source->receive(r, -1ns), Event::sample);
  EXPECT_GE(Clock::now() - begin, 39ms) << "two fields after the first; the third line is not overdue";
}

TEST_F(PlayFifo, AReaderThatWaitsForAWriterIsStopped) {
  const auto source = open_source(settings, 50.0);
  std::thread stopper([&source] { source->stop(); });
  EXPECT_EQ(source->receive(r, -1ns), Event::stopped);
  stopper.join();
  EXPECT_EQ(source->receive(r, -1ns), Event::stopped);
}

TEST_F(PlayFifo, AReaderThatWaitsForALineIsStopped) {
  const auto source = open_source(settings, 50.0);
  EXPECT_EQ(source->receive(r, 0ns), Event::idle);
  write("DMC01\n10:20");
  std::thread stopper([&source] { source->stop(); });
  EXPECT_EQ(source->receive(r, -1ns), Event::stopped);
  stopper.join();
}

TEST_F(PlayFifo, AFaultIsAnErrorThatNamesTheLine) {
  const auto error_of = [this](const std::string& text) {
    const auto source = open_source(settings, 50.0);
    static_cast<void>(source->receive(r, 0ns));
    write(text);
    close();
    Event event = Event::sample;
    while (event == Event::sample) event = source->receive(r, -1ns);
    EXPECT_EQ(event, Event::failed);
    EXPECT_EQ(source->statistics().state, SourceState::failed);
    return source->statistics().error;
  };
  EXPECT_THAT(error_of("DMC02\n"), HasSubstr(path + ":1: not a take"));
  EXPECT_THAT(error_of("DMC01\n"), HasSubstr(path + ":2: the file ends before the time code"));
  EXPECT_THAT(error_of(take + "oops\n"), HasSubstr(path + ":7: "));
  EXPECT_THAT(error_of("DMC01\n10:20:30:49:1\n1920 1080 14 2 12 4 27 18 27 18\n"), HasSubstr("10:20:30:49:1"));
  settings.loop = true;
  EXPECT_THROW(static_cast<void>(open_source(settings, 50.0)), TransportError);
}

}  // namespace trk_bridge::file::file_fifo_test
