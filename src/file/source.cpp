#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/clock.h"
#include "scheme.h"
#include "take.h"
#include "transport/counted_source.h"

namespace trk_bridge::file {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;
using transport::Deadline;
using transport::Event;
using transport::no_descriptor;
using transport::Reception;
using transport::Sample;
using transport::SenderKind;
using transport::Source;
using transport::SourceState;
using transport::SourceStatistics;
using transport::TransportError;
using transport::wait_readable;
using transport::Wake;

constexpr double highest_rate = 1e6;
constexpr long double century = 3.2e18L;  // ns
constexpr nanoseconds one_day = std::chrono::hours(24);

/// Midnight UTC of the day, nanoseconds since 1970.
std::int64_t midnight(const SourceSettings& settings) {
  if (settings.date) return *settings.date * 1'000'000'000;
  const std::int64_t now = base::wall_now();
  return now - now % one_day.count();
}

/// Plays a take at its field rate. The schedule is absolute from the first call on: a late reader catches up.
class FileSource final : public transport::CountedSource {
 public:
  FileSource(const SourceSettings& settings, double rate, Take take)
      : CountedSource("file " + settings.path),
        take_(std::move(take)),
        rate_(rate),
        speed_(settings.speed),
        loop_(settings.loop),
        time_(settings.time),
        midnight_(midnight(settings)) {}

  Event receive(Reception& into, nanoseconds wait) override {
    if (const Event end = final_event(); end != Event::sample) return end;
    const auto now = Clock::now();
    if (!begun_) {
      begun_ = true;
      begin_ = now;
    }
    if (position_ == take_.params.size() && !constants_due_) {
      if (!loop_) return ended();
      position_ = 0;
      constants_due_ = true;
    }
    if (const Event event = wait_until(due(), wait, now); event != Event::sample) return event;
    hand_out(into.sample);
    return sample(into.sample);
  }

 private:
  /// When the next record is to be handed out. Constants come with the first field of a round.
  Clock::time_point due() const {
    if (speed_ == 0) return begin_;
    // Up, so that nothing is ever early; a century is as good as never, and within what the clock can represent.
    const long double ahead =
        std::ceil(static_cast<long double>(played_) * 1e9L / static_cast<long double>(rate_ * speed_));
    return begin_ + nanoseconds(static_cast<std::int64_t>(std::min(ahead, century)));
  }

  /// `sample` once `due` has come, `idle` when `wait` is over before.
  Event wait_until(Clock::time_point due, nanoseconds wait, Clock::time_point now) {
    // As a difference, for `now + wait` may be past what the clock can represent.
    const bool in_time = wait < nanoseconds::zero() || due - now <= wait;
    const auto until = in_time ? due : now + wait;
    for (auto time = now; time < until; time = Clock::now()) {
      switch (wait_readable(no_descriptor, stop_event(), Deadline(until - time))) {
        case Wake::stopped:
          return Event::stopped;
        case Wake::failed:
          return failed(errno);
        case Wake::readable:
        case Wake::timeout:
          break;
      }
    }
    return in_time ? Event::sample : Event::idle;
  }

  void hand_out(Sample& sample) {
    sample = {};
    sample.origin = "ASCII";
    sample.sender.kind = SenderKind::file;
    sample.arrival = arrival();
    if (constants_due_) {
      sample.record = take_.constants;
      constants_due_ = false;
    } else {
      sample.record = take_.params[position_++];
      ++played_;
    }
  }

  void complete(SourceStatistics& statistics) const override {
    if (statistics.state == SourceState::waiting) statistics.waiting_for = name() + ": read, nothing played yet";
  }

  std::int64_t arrival() const {
    if (time_ == FileTime::now) return base::wall_now();
    // Whether the code fits the rate does not depend on the index, and was seen when opening.
    return midnight_ + *base::nanoseconds_of(take_.time_code, rate_, played_);
  }

  const Take take_;
  const double rate_;
  const double speed_;
  const bool loop_;
  const FileTime time_;
  const std::int64_t midnight_;

  bool begun_ = false;
  Clock::time_point begin_;
  bool constants_due_ = true;
  std::size_t position_ = 0;
  std::uint64_t played_ = 0;  // fields, over all rounds
};

}  // namespace

std::unique_ptr<Source> open_source(const SourceSettings& settings, double field_rate) {
  const double rate = settings.rate.value_or(field_rate);
  const auto refuse = [&settings](const std::string& reason) {
    throw TransportError("file " + settings.path + ": " + reason);
  };
  if (!(rate > 0 && rate <= highest_rate)) {
    refuse("rate=" + std::to_string(rate) + ": fields a second, more than 0 and at most " +
           std::to_string(highest_rate));
  }
  if (!std::isfinite(settings.speed) || settings.speed < 0) {
    refuse("speed=" + std::to_string(settings.speed) + ": 0 (as fast as possible) or more");
  }
  if (settings.date && std::abs(*settings.date) > latest_date) {
    refuse("date: " + std::to_string(*settings.date) +
           " seconds since 1970 are after 2249-12-31, the last day allowed");
  }
  Take take = read_take(settings.path);
  if (const auto first = base::nanoseconds_of(take.time_code, rate, 0); !first && settings.time == FileTime::timecode) {
    refuse(first.error() + "; say rate=HZ, or time=now to play without it");
  }
  if (settings.loop && take.params.empty()) refuse("loop=1: it has no parameters to play");
  return std::make_unique<FileSource>(settings, rate, std::move(take));
}

}  // namespace trk_bridge::file
