// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "cli/long_run.h"

#include <csignal>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/stop_signals.h"

namespace trk_bridge::cli::long_run_test {

TEST(LongRunTest, AShortRunPrintsNothing) {
  for (const bool is_terminal : {false, true}) {
    std::ostringstream err;
    {
      LongRun run(err, is_terminal);
      run.begin("reading take.bag");
      for (int i = 0; i < 100; ++i) run.at(i / 100.0);
    }
    EXPECT_EQ(err.str(), "");
  }
}

TEST(LongRunTest, OnATerminalItsLineIsRewrittenAndRemoved) {
  std::ostringstream err;
  {
    LongRun run(err, /*is_terminal=*/true);
    run.begin("reading take.bag");
    while (err.str().empty()) run.at(0.437);
    EXPECT_EQ(err.str(), "\r\033[Ktrk: reading take.bag: 43 %");
  }
  EXPECT_THAT(err.str(), testing::EndsWith("\r\033[K"));
}

TEST(LongRunTest, ASignalEndsIt) {
  std::ostringstream err;
  const StopSignals signals;
  LongRun run(err, /*is_terminal=*/false);
  run.begin("reading take.bag");
  run.at(0);
  std::raise(SIGINT);
  EXPECT_THROW(run.at(0.5), Interrupted);
}

}  // namespace trk_bridge::cli::long_run_test
