// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "base/process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace trk_bridge::base::process_test {

/// The exit code of a process that runs this, or minus the signal that ended it.
int outcome(const std::function<int()>& act) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(act());
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

volatile std::sig_atomic_t calls = 0;
void count_call() { calls = calls + 1; }

void pass(std::chrono::milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) ::usleep(1000);
}

TEST(StopSignals, TheFirstStopsAndOthersWithinTwoSecondsAreIgnored) {
  EXPECT_EQ(outcome([] {
              const StopSignals signals(count_call);
              if (StopSignals::received()) return 100;
              for (const int number : {SIGINT, SIGINT, SIGTERM, SIGTERM, SIGINT}) ::raise(number);
              if (!StopSignals::received()) return 101;
              return static_cast<int>(calls);
            }),
            1);
}

TEST(StopSignals, LaterSignalsEndTheProcess) {
  for (const int number : {SIGINT, SIGTERM}) {
    EXPECT_EQ(outcome([number] {
                const StopSignals signals(count_call);
                ::raise(number);
                pass(std::chrono::milliseconds(2100));
                ::raise(number);
                return 0;
              }),
              -number);
  }
}

TEST(StopSignals, WorkAfterTheScopeIsNotInterrupted) {
  EXPECT_EQ(outcome([] {
              {
                const StopSignals signals(count_call);
                ::raise(SIGINT);
              }
              ::raise(SIGINT);
              ::raise(SIGTERM);
              return static_cast<int>(calls);
            }),
            1);
}

TEST(StopSignals, WithoutASignalHandlersAreRestored) {
  EXPECT_EQ(outcome([] {
              { const StopSignals signals(count_call); }
              ::raise(SIGTERM);
              return 0;
            }),
            -SIGTERM);
}

TEST(StandardDescriptors, ClosedOnesAreOpenedOnDevNullAndOthersAreUnchanged) {
  EXPECT_EQ(outcome([] {
              struct stat before {};
              if (::fstat(STDOUT_FILENO, &before) != 0) return 1;
              ::close(STDIN_FILENO);
              ::close(STDERR_FILENO);
              open_standard_descriptors();
              struct stat null {};
              if (::stat("/dev/null", &null) != 0) return 2;
              for (const int fd : {STDIN_FILENO, STDERR_FILENO}) {
                struct stat there {};
                if (::fstat(fd, &there) != 0 || there.st_rdev != null.st_rdev) return 3;
              }
              struct stat after {};
              if (::fstat(STDOUT_FILENO, &after) != 0 || after.st_ino != before.st_ino) return 4;
              return ::write(STDERR_FILENO, "x", 1) == 1 ? 0 : 5;
            }),
            0);
}

}  // namespace trk_bridge::base::process_test
