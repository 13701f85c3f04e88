#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "backends.h"
#include "readable.h"
#include "stop_event.h"
#include "trk_bridge/transport/snapshot.h"
#include "trk_bridge/transport/take_file.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::transport {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr double highest_rate = 1e6;
// Nanoseconds since 1970 end in 2262, and a take goes on for a while.
constexpr std::int64_t latest_date = 8'836'000'000;  // s, in 2250
constexpr long double century = 3.2e18L;             // ns
// poll() passes over it: only time and stop() count.
constexpr int no_descriptor = -1;
constexpr nanoseconds one_day = std::chrono::hours(24);

std::int64_t wall_now() {
  return std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// Midnight UTC of the day, nanoseconds since 1970.
std::int64_t midnight(const FileEndpoint& endpoint) {
  if (endpoint.date) return *endpoint.date * 1'000'000'000;
  const std::int64_t now = wall_now();
  return now - now % one_day.count();
}

struct Counts {
  std::uint64_t records = 0, unknown_format_bits = 0;
  bool ended = false;
  int error = 0;  // errno
};

/// Plays a take at its field rate. The schedule is absolute from the first call on: a late reader catches up.
class FileSource final : public Source {
 public:
  FileSource(const FileEndpoint& endpoint, double rate, Take take)
      : path_(endpoint.path),
        take_(std::move(take)),
        rate_(rate),
        speed_(endpoint.speed),
        loop_(endpoint.loop),
        time_(endpoint.time),
        midnight_(midnight(endpoint)) {}

  Event receive(Reception& into, nanoseconds wait) override {
    if (stop_.is_set()) return Event::stopped;
    if (counts_.error != 0) return Event::failed;
    const auto now = Clock::now();
    if (!begun_) {
      begun_ = true;
      begin_ = now;
    }
    if (position_ == take_.params.size() && !constants_due_) {
      if (!loop_) {
        if (!counts_.ended) {
          counts_.ended = true;
          published_.store(counts_);
        }
        return Event::ended;
      }
      position_ = 0;
      constants_due_ = true;
    }
    if (const Event event = wait_until(due(), wait, now); event != Event::sample) return event;
    hand_out(into);
    return Event::sample;
  }

  void stop() noexcept override { stop_.set(); }

  SourceStatistics statistics() const override {
    const Counts counts = published_.load();
    SourceStatistics s;
    s.records = counts.records;
    s.unknown_format_bits = counts.unknown_format_bits;
    if (counts.error != 0) {
      s.state = SourceState::failed;
      s.error = name() + ": waiting failed: " + std::system_category().message(counts.error);
    } else if (counts.ended) {
      s.state = SourceState::ended;
    } else if (counts.records > 0) {
      s.state = SourceState::receiving;
    } else {
      s.waiting_for = name() + ": read, nothing played yet";
    }
    return s;
  }

  std::string name() const override { return "file " + path_; }

 private:
  /// When the next record is to be handed out. Constants come with the first field of a round.
  Clock::time_point due() const {
    if (speed_ == 0) return begin_;
    // Up, so that nothing is ever early; a century is as good as never, and within what the clock can tell.
    const long double ahead =
        std::ceil(static_cast<long double>(played_) * 1e9L / static_cast<long double>(rate_ * speed_));
    return begin_ + nanoseconds(static_cast<std::int64_t>(std::min(ahead, century)));
  }

  /// `sample` once `due` has come, `idle` when `wait` is over before.
  Event wait_until(Clock::time_point due, nanoseconds wait, Clock::time_point now) {
    // As a difference, for `now + wait` may be past what the clock can tell.
    const bool in_time = wait < nanoseconds::zero() || due - now <= wait;
    const auto until = in_time ? due : now + wait;
    for (auto time = now; time < until; time = Clock::now()) {
      switch (wait_readable(no_descriptor, stop_, Deadline(until - time))) {
        case Wake::stopped:
          return Event::stopped;
        case Wake::failed:
          counts_.error = errno;
          published_.store(counts_);
          return Event::failed;
        case Wake::readable:
        case Wake::timeout:
          break;
      }
    }
    return in_time ? Event::sample : Event::idle;
  }

  void hand_out(Reception& into) {
    Sample& sample = into.sample;
    sample.form = {};
    sample.sender = {};
    sample.sender.kind = SenderKind::file;
    sample.arrival = arrival();
    if (constants_due_) {
      sample.record = take_.constants;
      constants_due_ = false;
    } else {
      const wire::CameraParams& params = take_.params[position_++];
      sample.record = params;
      ++played_;
      if ((params.format & ~wire::known_format_bits) != 0) ++counts_.unknown_format_bits;
    }
    ++counts_.records;
    published_.store(counts_);
  }

  std::int64_t arrival() const {
    if (time_ == FileTime::now) return wall_now();
    // Whether the code fits the rate does not depend on the index, and was seen when opening.
    return midnight_ + *nanoseconds_of(take_.time_code, rate_, played_);
  }

  const std::string path_;
  const Take take_;
  const double rate_;
  const double speed_;
  const bool loop_;
  const FileTime time_;
  const std::int64_t midnight_;

  StopEvent stop_;
  bool begun_ = false;
  Clock::time_point begin_;
  bool constants_due_ = true;
  std::size_t position_ = 0;
  std::uint64_t played_ = 0;  // fields, over all rounds
  Counts counts_;
  Snapshot<Counts> published_;
};

}  // namespace

std::unique_ptr<Source> open_file_source(const FileEndpoint& endpoint, double field_rate) {
  const double rate = endpoint.rate.value_or(field_rate);
  const auto refuse = [&endpoint](const std::string& reason) {
    throw TransportError("file " + endpoint.path + ": " + reason);
  };
  if (!(rate > 0 && rate <= highest_rate)) {
    refuse("rate=" + std::to_string(rate) + ": fields a second, more than 0 and at most " +
           std::to_string(highest_rate));
  }
  if (!std::isfinite(endpoint.speed) || endpoint.speed < 0) {
    refuse("speed=" + std::to_string(endpoint.speed) + ": 0 (as fast as possible) or more");
  }
  if (endpoint.date && std::abs(*endpoint.date) > latest_date) {
    refuse("date: " + std::to_string(*endpoint.date) + " s are out of reach; days up to the year 2250 are not");
  }
  Take take = read_take(endpoint.path);
  if (const auto first = nanoseconds_of(take.time_code, rate, 0); !first && endpoint.time == FileTime::timecode) {
    refuse(first.error() + "; say rate=HZ, or time=now to play without it");
  }
  if (endpoint.loop && take.params.empty()) refuse("loop=1: it has no parameters to play");
  return std::make_unique<FileSource>(endpoint, rate, std::move(take));
}

}  // namespace trk_bridge::transport
