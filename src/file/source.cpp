#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
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

/// Why a take with this code cannot be played; empty when it can.
std::string fault_of(const base::TimeCode& code, double rate, FileTime time) {
  if (time == FileTime::now) return {};
  const auto first = base::nanoseconds_of(code, rate, 0);
  return first ? std::string() : first.error() + "; say rate=HZ, or time=now to play without it";
}

/// Plays a take at its field rate. The schedule is absolute from the first call on, or from when a FIFO's writer began:
/// a late reader catches up. A regular file has been read as a whole when it was opened, a FIFO is read as it is
/// played. Lines that were left out are reported first, those of a FIFO when they come.
class FileSource final : public transport::CountedSource {
 public:
  FileSource(const SourceSettings& settings, double rate, Take take, std::unique_ptr<TakeReader> fifo)
      : CountedSource("file " + settings.path),
        take_(std::move(take)),
        fifo_(std::move(fifo)),
        rate_(rate),
        speed_(settings.speed),
        loop_(settings.loop),
        time_(settings.time),
        midnight_(midnight(settings)),
        constants_due_(!fifo_) {}

  Event receive(Reception& into, nanoseconds wait) override {
    if (const Event end = final_event(); end != Event::sample) return end;
    if (reported_ < take_.left_out.size()) return left_out(take_.left_out[reported_++].fault, into);
    auto now = Clock::now();
    if (fifo_ && !constants_due_ && !next_) {
      if (const Event event = fetch(into, wait); event != Event::sample) return event;
      const auto fetched = Clock::now();
      if (wait > nanoseconds::zero()) wait = std::max(nanoseconds::zero(), wait - (fetched - now));
      now = fetched;
    }
    if (!begin_) begin_ = now;
    if (!fifo_ && position_ == take_.params.size() && !constants_due_) {
      if (!loop_) return ended();
      position_ = 0;
      round_begin_ = played_;
      gaps_passed_ = 0;
      constants_due_ = true;
    }
    if (!constants_due_) pass_gaps();
    if (const Event event = wait_until(due(), wait, now); event != Event::sample) return event;
    hand_out(into.sample);
    return sample(into.sample);
  }

 private:
  /// When the next record is to be handed out. Constants come with the first field of a round.
  Clock::time_point due() const {
    if (speed_ == 0) return *begin_;
    // Up, so that nothing is ever early; a century is as good as never, and within what the clock can represent.
    const long double ahead =
        std::ceil(static_cast<long double>(played_) * 1e9L / static_cast<long double>(rate_ * speed_));
    return *begin_ + nanoseconds(static_cast<std::int64_t>(std::min(ahead, century)));
  }

  /// `sample` once `due` has come, `idle` when `wait` is over before.
  Event wait_until(Clock::time_point due, nanoseconds wait, Clock::time_point now) {
    // As a difference, for `now + wait` may be past what the clock can represent.
    const bool in_time = wait < nanoseconds::zero() || due - now <= wait;
    const auto until = in_time ? due : now + wait;
    for (auto time = Clock::now(); time < until; time = Clock::now()) {
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

  /// A line that was left out was a field as well: the others keep their times.
  void pass_gaps() {
    const auto& gaps = take_.left_out;
    for (; gaps_passed_ < gaps.size() && gaps[gaps_passed_].position == position_; ++gaps_passed_) ++played_;
  }

  /// The next record of a FIFO: `sample` once there is one to be handed out.
  Event fetch(Reception& into, nanoseconds wait) {
    const Deadline deadline(wait);
    for (;;) {
      switch (fifo_->next()) {
        case TakeReader::Got::head:
          take_.time_code = fifo_->time_code();
          take_.constants = fifo_->constants();
          if (const auto unfit = fault_of(take_.time_code, rate_, time_); !unfit.empty()) return failed_with(unfit);
          begin_.reset();
          constants_due_ = true;
          return Event::sample;
        case TakeReader::Got::params:
          next_ = fifo_->params();
          return Event::sample;
        case TakeReader::Got::left_out:
          ++played_;
          return left_out(fifo_->fault(), into);
        case TakeReader::Got::cut:
          return left_out(fifo_->fault(), into);
        case TakeReader::Got::end:
          return ended();
        case TakeReader::Got::failed:
          return failed_with(fifo_->error());
        case TakeReader::Got::nothing_yet:
          break;
      }
      switch (wait_readable(fifo_->fd(), stop_event(), deadline)) {
        case Wake::stopped:
          return Event::stopped;
        case Wake::failed:
          return failed(errno);
        case Wake::timeout:
          return Event::idle;
        case Wake::readable:
          break;
      }
    }
  }

  Event left_out(const transport::Fault& fault, Reception& into) {
    set_source(into.sample);
    into.sample.arrival = base::wall_now();
    into.fault = fault;
    return malformed();
  }

  Event failed_with(const std::string& reason) {
    failure_ = reason;
    return failed(EBADMSG);
  }

  static void set_source(Sample& sample) {
    sample = {};
    sample.origin = "ASCII";
    sample.sender.kind = SenderKind::file;
  }

  void hand_out(Sample& sample) {
    set_source(sample);
    sample.arrival = arrival();
    if (constants_due_) {
      sample.record = take_.constants;
      constants_due_ = false;
      return;
    }
    if (fifo_) {
      sample.record = *next_;
      next_.reset();
    } else {
      sample.record = take_.params[position_++];
    }
    sample.time_code = time_code();
    ++played_;
  }

  /// Of the field that comes next; none where the take's code does not fit the rate.
  std::optional<base::CountedTimeCode> time_code() const {
    const auto code = base::time_code_after(take_.time_code, rate_, played_ - round_begin_);
    if (!code) return std::nullopt;
    return base::CountedTimeCode{*code, rate_};
  }

  void complete(SourceStatistics& statistics) const override {
    if (statistics.state == SourceState::waiting) {
      statistics.waiting_for = name() + (fifo_ ? ": a FIFO, nothing written yet" : ": read, nothing played yet");
    }
    // Written before the state, and not again.
    if (statistics.state == SourceState::failed && !failure_.empty()) statistics.error = failure_;
  }

  std::int64_t arrival() const {
    if (time_ == FileTime::now) return base::wall_now();
    // Whether the code fits the rate does not depend on the index, and was seen before.
    return midnight_ + *base::nanoseconds_of(take_.time_code, rate_, played_);
  }

  Take take_;  // of a FIFO the head
  const std::unique_ptr<TakeReader> fifo_;
  const double rate_;
  const double speed_;
  const bool loop_;
  const FileTime time_;
  const std::int64_t midnight_;
  std::string failure_;

  std::optional<Clock::time_point> begin_;
  bool constants_due_;
  std::optional<wire::CameraParams> next_;  // of a FIFO
  std::size_t position_ = 0;
  std::size_t reported_ = 0, gaps_passed_ = 0;  // of the lines left out
  std::uint64_t played_ = 0;                    // fields, over all rounds
  std::uint64_t round_begin_ = 0;               // played_ when this round began
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
  auto reader = std::make_unique<TakeReader>(settings.path, settings.lenient ? Unsound::is_left_out : Unsound::is_error,
                                             Waiting::never);
  if (reader->is_fifo()) {
    if (settings.loop) refuse("loop=1: a FIFO can be played once");
    return std::make_unique<FileSource>(settings, rate, Take{}, std::move(reader));
  }
  Take take = read_take(*reader);
  if (const auto unfit = fault_of(take.time_code, rate, settings.time); !unfit.empty()) refuse(unfit);
  if (settings.loop && take.params.empty()) refuse("loop=1: it has no parameters to play");
  return std::make_unique<FileSource>(settings, rate, std::move(take), nullptr);
}

}  // namespace trk_bridge::file
