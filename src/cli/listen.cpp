// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "listen.h"

#include <chrono>
#include <ostream>

namespace trk_bridge::cli {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr nanoseconds for_ever{-1};
// s, about three years: longer limits count as no limit, so that the clock does not overflow.
constexpr double longest_limit = 1e8;

}  // namespace

Ending listen(transport::Source& source, Listener& listener, std::optional<double> seconds) {
  const bool is_limited = seconds && *seconds < longest_limit;
  const auto limit = is_limited ? std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(*seconds))
                                : nanoseconds::zero();
  const auto deadline = Clock::now() + limit;
  transport::Reception reception;
  for (;;) {
    const nanoseconds left = is_limited ? nanoseconds(deadline - Clock::now()) : for_ever;
    if (is_limited && left <= nanoseconds::zero()) return Ending::enough;
    switch (source.receive(reception, left)) {
      case transport::Event::sample:
        if (!listener.on_sample(reception.sample)) return Ending::enough;
        break;
      case transport::Event::malformed:
        listener.on_malformed(reception);
        break;
      case transport::Event::idle:
        break;
      case transport::Event::stopped:
        return Ending::stopped;
      case transport::Event::ended:
        return Ending::ended;
      case transport::Event::failed:
        return Ending::failed;
    }
  }
}

ExitCode report_end(const Tally& tally, const transport::SourceStatistics& source, Ending ending, bool has_limit,
                    std::ostream& err) {
  tally.summarise(source, err);
  if (!source.waiting_for.empty()) err << "trk: waited for " << source.waiting_for << '\n';
  if (ending == Ending::failed) {
    err << "trk: error: " << source.error << '\n';
    return exit_failed;
  }
  return has_limit && tally.received() == 0 ? exit_nothing : exit_good;
}

}  // namespace trk_bridge::cli
