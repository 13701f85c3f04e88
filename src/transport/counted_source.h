// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Base class of all sources: counts, the state derived from them, and the end.
#pragma once

#include <string>

#include "trk_bridge/base/snapshot.h"
#include "trk_bridge/transport/source.h"
#include "waiting.h"

namespace trk_bridge::transport {

/// Counts what a source returns and derives its state from the counts. A source that waits for more than stop_event()
/// extends stop(). The protected functions belong to the thread of receive().
class CountedSource : public Source {
 public:
  void stop() noexcept override { stop_.set(); }
  SourceStatistics statistics() const final;
  std::string name() const final { return name_; }

 protected:
  explicit CountedSource(std::string name) : name_(std::move(name)) {}

  const StopEvent& stop_event() const noexcept { return stop_; }
  /// `stopped`, `ended` or `failed` if receive() must return this from now on; otherwise `sample`.
  Event final_event() const noexcept { return stop_.is_set() ? Event::stopped : counts_.end; }

  /// Each of these counts and returns the result for receive().
  Event sample(const Sample&) noexcept;
  Event malformed() noexcept;
  Event ended() noexcept;
  /// The source cannot continue: `error` is an errno.
  Event failed(int error) noexcept;
  /// Counts a datagram from a sender that is not allowed.
  void refused(const Sender&) noexcept;

 private:
  struct Counts {
    std::uint64_t records = 0, malformed = 0, refused = 0, unknown_format_bits = 0, doubtful = 0;
    const char* last_doubt = "";
    Sender last_refused;
    Event end = Event::sample;  ///< ended and failed are permanent
    int error = 0;
  };

  /// Adds the values of this kind of source, and `waiting_for` if it is waiting. Any thread.
  virtual void complete(SourceStatistics&) const = 0;

  const std::string name_;
  StopEvent stop_;
  Counts counts_;
  base::Snapshot<Counts> published_;
};

}  // namespace trk_bridge::transport
