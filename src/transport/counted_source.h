// What every source has: its counts, the state that follows from them, and an end.
#pragma once

#include <string>

#include "trk_bridge/base/snapshot.h"
#include "trk_bridge/transport/source.h"
#include "waiting.h"

namespace trk_bridge::transport {

/// Counts what a source hands out and derives its state from that. A source that waits for more than stop_event() adds
/// to stop(). The protected functions belong to the thread of receive().
class CountedSource : public Source {
 public:
  void stop() noexcept override { stop_.set(); }
  SourceStatistics statistics() const final;
  std::string name() const final { return name_; }

 protected:
  explicit CountedSource(std::string name) : name_(std::move(name)) {}

  const StopEvent& stop_event() const noexcept { return stop_; }
  /// What receive() answers from now on whatever comes: stopped, ended or failed. Otherwise `sample`.
  Event final_event() const noexcept { return stop_.is_set() ? Event::stopped : counts_.end; }

  /// Each counts, and returns what receive() should.
  Event sample(const Sample&) noexcept;
  Event malformed() noexcept;
  Event ended() noexcept;
  /// The source cannot go on: `error` is an errno.
  Event failed(int error) noexcept;
  /// Counts a datagram of a sender that is not allowed.
  void refused(const Sender&) noexcept;

 private:
  struct Counts {
    std::uint64_t records = 0, malformed = 0, refused = 0, unknown_format_bits = 0, doubtful = 0;
    const char* last_doubt = "";
    Sender last_refused;
    Event end = Event::sample;  ///< ended and failed are for good
    int error = 0;
  };

  /// Adds what only this kind of source knows; `waiting_for` where it is waiting. Any thread.
  virtual void complete(SourceStatistics&) const = 0;

  const std::string name_;
  StopEvent stop_;
  Counts counts_;
  base::Snapshot<Counts> published_;
};

}  // namespace trk_bridge::transport
