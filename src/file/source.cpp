// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
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
#include "base/number_text.h"
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
constexpr const char* nothing_to_loop = "loop=1: the take has no parameters to play";

/// Midnight UTC of the day, nanoseconds since 1970.
std::int64_t midnight(const SourceSettings& settings) {
  if (settings.date) return *settings.date * 1'000'000'000;
  const std::int64_t now = base::wall_now();
  return now - now % one_day.count();
}

/// The time codes of a take. If the first one does not fit the rate: an error if time codes are needed, else none.
tl::expected<std::optional<base::TimeCodeSeries>, std::string> codes_of(const TakeReader& take, double rate,
                                                                        FileTime time) {
  const auto codes = base::TimeCodeSeries::from(take.time_code(), rate);
  if (codes) return *codes;
  if (time == FileTime::now) return std::nullopt;
  return tl::unexpected(codes.error() + "; set rate=HZ, or time=now to play without it");
}

/// Plays a take at its field rate, line by line. The schedule is absolute from the first call, or from the start of the
/// writer of a FIFO: a late reader catches up. A field is read before its time, so that a slow disk does not delay it.
/// Skipped lines are reported when they are reached, and in a loop only in the first round.
class FileSource final : public transport::CountedSource {
 public:
  /// For a regular file, the reader has read the head, and `codes` are those of the take.
  FileSource(const SourceSettings& settings, double rate, std::unique_ptr<TakeReader> take,
             std::optional<base::TimeCodeSeries> codes)
      : CountedSource("file " + settings.path),
        take_(std::move(take)),
        rate_(rate),
        speed_(settings.speed),
        loop_(settings.loop),
        time_(settings.time),
        midnight_(midnight(settings)),
        codes_(codes),
        constants_due_(!take_->is_fifo()) {}

  Event receive(Reception& into, nanoseconds wait) override {
    if (const Event end = final_event(); end != Event::sample) return end;
    const Deadline deadline(wait);
    if (!constants_due_ && !has_next_) {
      if (const Event event = fetch(into, deadline); event != Event::sample) return event;
    }
    if (speed_ != 0) {
      if (const Event event = wait_until_due(deadline); event != Event::sample) return event;
    }
    hand_out(into.sample);
    return sample(into.sample);
  }

 private:
  /// When the next record must be returned. Constants are returned with the first field of a round.
  Clock::time_point due() const {
    // Rounded up, so that nothing is early. Limited to a century, which the clock can represent.
    const long double ahead =
        std::ceil(static_cast<long double>(played_) * 1e9L / static_cast<long double>(rate_ * speed_));
    return *begin_ + nanoseconds(static_cast<std::int64_t>(std::min(ahead, century)));
  }

  /// `sample` when the next record is due, `idle` if the deadline is earlier.
  Event wait_until_due(const Deadline& deadline) {
    auto now = Clock::now();
    if (!begin_) begin_ = now;
    for (const auto until = due(); now < until; now = Clock::now()) {
      if (deadline.has_passed()) return Event::idle;
      const nanoseconds left = until - now;
      const Deadline first(deadline.is_endless() ? left : std::min(left, deadline.left()));
      switch (wait_readable(no_descriptor, stop_event(), first)) {
        case Wake::stopped:
          return Event::stopped;
        case Wake::failed:
          return failed(errno);
        case Wake::readable:
        case Wake::timeout:
          break;
      }
    }
    return Event::sample;
  }

  /// Reads the next record of the take: `sample` when there is one.
  Event fetch(Reception& into, const Deadline& deadline) {
    for (;;) {
      switch (take_->next()) {
        case TakeReader::Got::head:
          return begin();
        case TakeReader::Got::params:
          has_next_ = has_field_ = true;
          return Event::sample;
        case TakeReader::Got::skipped:
          // It was a field, too: the others keep their times.
          ++played_;
          if (!is_first_round_) break;
          return skipped(into);
        case TakeReader::Got::truncated:
          if (!is_first_round_) break;
          return skipped(into);
        case TakeReader::Got::end:
          if (!loop_) return ended();
          return next_round();
        case TakeReader::Got::failed:
          return failed_with(take_->error());
        case TakeReader::Got::nothing_yet:
          if (const Event event = await_writer(deadline); event != Event::sample) return event;
          break;
      }
    }
  }

  Event await_writer(const Deadline& deadline) {
    switch (wait_readable(take_->fd(), stop_event(), deadline)) {
      case Wake::stopped:
        return Event::stopped;
      case Wake::failed:
        return failed(errno);
      case Wake::timeout:
        return Event::idle;
      case Wake::readable:
        break;
    }
    return Event::sample;
  }

  /// After the head of a FIFO.
  Event begin() {
    const auto codes = codes_of(*take_, rate_, time_);
    if (!codes) return failed_with(codes.error());
    codes_ = *codes;
    constants_due_ = true;
    return Event::sample;
  }

  Event next_round() {
    // The file may have been emptied meanwhile: it would be read in an endless loop.
    if (!has_field_) return failed_with(take_->path() + ": " + nothing_to_loop);
    if (!take_->rewind()) return failed_with(take_->error());
    has_field_ = is_first_round_ = false;
    round_begin_ = played_;
    constants_due_ = true;
    return Event::sample;
  }

  Event skipped(Reception& into) {
    set_source(into.sample);
    into.sample.arrival = base::wall_now();
    into.fault = take_->fault();
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
      sample.record = take_->constants();
      constants_due_ = false;
      return;
    }
    sample.record = take_->params();
    if (codes_) sample.time_code = base::TimeCodeWithRate{codes_->code(played_ - round_begin_), rate_};
    has_next_ = false;
    ++played_;
  }

  void complete(SourceStatistics& statistics) const override {
    if (statistics.state == SourceState::waiting) {
      statistics.waiting_for =
          name() + (take_->is_fifo() ? ": a FIFO, nothing written yet" : ": open, nothing played yet");
    }
    // WriteResult once, before the state.
    if (statistics.state == SourceState::failed && !failure_.empty()) statistics.error = failure_;
  }

  std::int64_t arrival() const {
    if (time_ == FileTime::now) return base::wall_now();
    return midnight_ + codes_->nanoseconds(played_);
  }

  const std::unique_ptr<TakeReader> take_;
  const double rate_;
  const double speed_;
  const bool loop_;
  const FileTime time_;
  const std::int64_t midnight_;
  std::optional<base::TimeCodeSeries> codes_;
  std::string failure_;

  std::optional<Clock::time_point> begin_;
  bool constants_due_;
  bool has_next_ = false;   // take_->params() is the next record
  bool has_field_ = false;  // in this round
  bool is_first_round_ = true;
  std::uint64_t played_ = 0;       // fields, over all rounds
  std::uint64_t round_begin_ = 0;  // played_ when this round began
};

/// Whether there is a field to play, even after many skipped lines. Throws TransportError.
bool has_field(const std::string& path, MalformedLines malformed) {
  TakeReader take(path, malformed, Waiting::never);
  for (;;) {
    switch (take.next()) {
      case TakeReader::Got::params:
        return true;
      case TakeReader::Got::end:
        return false;
      case TakeReader::Got::failed:
        throw TransportError(take.error());
      default:
        break;
    }
  }
}

}  // namespace

std::unique_ptr<Source> open_source(const SourceSettings& settings, double field_rate) {
  const double rate = settings.rate.value_or(field_rate);
  const auto refuse = [&settings](const std::string& reason) {
    throw TransportError("file " + settings.path + ": " + reason);
  };
  if (!(rate > 0 && rate <= highest_rate)) {
    refuse("rate=" + base::number_text(rate) + ": fields a second, more than 0 and at most " +
           base::number_text(highest_rate));
  }
  if (!std::isfinite(settings.speed) || settings.speed < 0) {
    refuse("speed=" + base::number_text(settings.speed) + ": 0 (as fast as possible) or more");
  }
  if (settings.date && std::abs(*settings.date) > latest_date) {
    refuse("date: " + std::to_string(*settings.date) +
           " seconds since 1970 are after 2249-12-31, the last day allowed");
  }
  const MalformedLines malformed = settings.lenient ? MalformedLines::are_skipped : MalformedLines::are_errors;
  auto take = std::make_unique<TakeReader>(settings.path, malformed, Waiting::never);
  if (take->is_fifo()) {
    if (settings.loop) refuse("loop=1: a FIFO can be played once");
    return std::make_unique<FileSource>(settings, rate, std::move(take), std::nullopt);
  }
  if (take->next() != TakeReader::Got::head) throw TransportError(take->error());
  const auto codes = codes_of(*take, rate, settings.time);
  if (!codes) refuse(codes.error());
  if (settings.loop && !has_field(settings.path, malformed)) refuse(nothing_to_loop);
  return std::make_unique<FileSource>(settings, rate, std::move(take), *codes);
}

}  // namespace trk_bridge::file
