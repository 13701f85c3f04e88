// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdint>
#include <ctime>
#include <memory>
#include <optional>
#include <string>

#include <linux/futex.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/clock.h"
#include "cadence.h"
#include "link.h"
#include "scheme.h"
#include "transport/counted_source.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::shm {
namespace {

using Clock = Link::Clock;
using std::chrono::nanoseconds;
using transport::Event;
using transport::SourceState;

/// The shortest time between reads if the records are malformed.
constexpr nanoseconds malformed_period = std::chrono::microseconds(250);

/// How long after its last set a writer that does not wake readers is polled for.
constexpr nanoseconds quiet_writer_memory = std::chrono::seconds(2);

std::int64_t nanoseconds_of(Clock::time_point time) noexcept { return nanoseconds(time.time_since_epoch()).count(); }

/// CPU time of this thread, ns.
std::int64_t cpu_time() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

/// Sleeps of this thread end as exactly as possible, not with the default slack of 50 us.
void end_sleeps_exactly() noexcept {
  static thread_local const int done = ::prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0);
  static_cast<void>(done);
}

/// Sleeps until a writer in another process or stop() wakes it. Needs Linux 5.16; otherwise only stop() and the time
/// limit end a sleep.
class Sleeper {
 public:
  /// False: writers cannot wake it, and the caller must poll.
  bool can_be_woken() const noexcept { return has_futex_waitv_; }
  /// Ends every sleep, now and later. Any thread, safe in a signal handler; errno is not changed.
  void stop() noexcept {
    const int saved = errno;
    stopped_ = 1;
    ::syscall(SYS_futex, &stopped_, FUTEX_WAKE_PRIVATE, INT_MAX, nullptr, nullptr, 0);
    errno = saved;
  }
  /// False if the system does not support it; can_be_woken() is false from then on.
  bool sleep(Clock::time_point until, const std::optional<Segment::Waiter>& writer) noexcept {
    struct Futex {
      std::uint64_t value, address;
      std::uint32_t flags, reserved;
    };
    constexpr std::uint32_t of_32_bits = 2;
    std::array<Futex, 2> futexes{
        {{0, reinterpret_cast<std::uintptr_t>(&stopped_), of_32_bits | FUTEX_PRIVATE_FLAG, 0}}};
    if (writer) futexes[1] = {writer->value, reinterpret_cast<std::uintptr_t>(writer->word), of_32_bits, 0};
    const std::int64_t at = nanoseconds_of(until);
    timespec time{};
    time.tv_sec = static_cast<time_t>(at / 1'000'000'000);
    time.tv_nsec = static_cast<long>(at % 1'000'000'000);
    constexpr long futex_waitv = 449;  // on every architecture
    const long woken = ::syscall(futex_waitv, futexes.data(), writer ? 2 : 1, 0, &time, CLOCK_MONOTONIC);
    has_futex_waitv_ = woken >= 0 || errno == EAGAIN || errno == EINTR || errno == ETIMEDOUT;
    return has_futex_waitv_;
  }

 private:
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free && sizeof(std::atomic<std::uint32_t>) == 4);
  std::atomic<std::uint32_t> stopped_{0};
  bool has_futex_waitv_ = true;
};

/// State of the attachment, for statistics.
struct Attachment {
  std::uint64_t attached = 0, overwritten = 0;
  bool absent = true;
  bool has_32_bit_program = false;
  SlotFault why{SlotProblem::no_file};
};

/// Looks for a segment until there is one. Then it sleeps until a writer wakes it or, for writers that do not wake
/// readers, until the next poll.
class ShmSource final : public transport::CountedSource {
 public:
  explicit ShmSource(const Settings& settings)
      : CountedSource("shm slot " + std::to_string(settings.slot)),
        slot_(settings.slot),
        link_(Link::Options{settings.slot, nullptr, settings.mode, false}) {
    if (slot_ < 0 || slot_ >= slot_count) {
      throw transport::TransportError("shm " + describe({SlotProblem::bad_slot, slot_}));
    }
    attachment_.why.slot = slot_;
    published_.store(attachment_);
    keep(Clock::now());
  }

  void stop() noexcept override {
    CountedSource::stop();
    sleeper_.stop();
  }

  Event receive(transport::Reception& into, nanoseconds wait) override {
    const auto begin = Clock::now();
    for (auto now = begin;; now = Clock::now()) {
      if (const Event end = final_event(); end != Event::sample) return end;
      keep(now);
      if (now >= next_look_) {
        if (const Event event = look(into, now); event != Event::idle) return event;
      }
      const bool endless = wait < nanoseconds::zero();
      // As a difference, because `begin + wait` may overflow.
      const nanoseconds left = endless ? nanoseconds::max() : wait - (now - begin);
      if (left <= nanoseconds::zero()) return Event::idle;
      if (!sleep(now, left)) return failed(errno);
    }
  }

 private:
  void keep(Clock::time_point now) {
    const auto kept = link_.keep(now);
    const bool has_32_bit_program = link_.segment() != nullptr && link_.segment()->has_32_bit_program();
    const bool changed = attachment_.absent == kept.has_value() || attachment_.attached != link_.attached() ||
                         attachment_.has_32_bit_program != has_32_bit_program ||
                         (!kept && !(attachment_.why == kept.error()));
    if (!changed) return;
    if (attachment_.attached != link_.attached()) cadence_ = Cadence(nanoseconds_of(now));
    attachment_.absent = !kept;
    if (!kept) attachment_.why = kept.error();
    attachment_.attached = link_.attached();
    attachment_.has_32_bit_program = has_32_bit_program;
    published_.store(attachment_);
  }

  /// Sleeps until the next poll, at most `most`, or until a writer or stop() wakes it. False, with errno: it cannot
  /// sleep.
  bool sleep(Clock::time_point now, nanoseconds most) {
    nanoseconds time = Link::attach_period;
    std::optional<Segment::Waiter> writer;
    if (link_.segment() != nullptr && now < next_look_) {
      time = next_look_ - now;
    } else if (link_.segment() != nullptr) {
      time = nanoseconds(is_woken(now) ? Cadence::slowest : cadence_.next(nanoseconds_of(now)) - nanoseconds_of(now));
      if (time <= nanoseconds::zero()) {
        ::sched_yield();
        return true;
      }
      if (can_be_woken()) {
        writer = link_.segment()->wait_for_write();
        if (link_.has_new_params() || link_.has_new_constants()) return true;
      }
    }
    end_sleeps_exactly();
    time = std::min(time, most);
    const std::int64_t cpu_before = cpu_time();
    bool has_slept = sleeper_.can_be_woken() && sleeper_.sleep(now + time, writer);
    if (!has_slept) {
      const transport::Deadline end(time);
      has_slept = transport::wait_readable(transport::no_descriptor, stop_event(), end) != transport::Wake::failed;
    }
    cadence_.slept(cpu_time() - cpu_before);
    return has_slept;
  }

  /// Whether writers of this package can wake it.
  bool can_be_woken() const noexcept { return sleeper_.can_be_woken() && link_.segment()->writable(); }
  /// Whether, as far as known, every writer wakes it.
  bool is_woken(Clock::time_point now) const noexcept {
    return can_be_woken() && link_.segment()->is_announced() && now >= look_until_;
  }

  /// Reports that a poll at `now` found this number of parameters.
  void learn(Clock::time_point now, unsigned sets) noexcept {
    // A set that was replaced before it was read may have been from another writer.
    if (sets > 1 || (sets > 0 && !link_.segment()->is_announced())) look_until_ = now + quiet_writer_memory;
    if (!is_woken(now)) cadence_.polled(nanoseconds_of(now), sets);
  }

  /// Constants first, because parameters are decoded with them.
  Event look(transport::Reception& into, Clock::time_point now) {
    if (link_.segment() == nullptr) return Event::idle;
    ReadResult met = link_.read(constants_, into.fault);
    const bool is_constants = met != ReadResult::nothing;
    if (!is_constants) {
      met = link_.read(params_, into.fault);
      const bool is_new = met != ReadResult::nothing;
      learn(now, is_new ? static_cast<unsigned>(1 + link_.overwritten() - attachment_.overwritten) : 0);
      if (!is_new) return Event::idle;
    }
    transport::Sample& sample = into.sample;
    sample = {};
    sample.arrival = base::wall_now();
    sample.sender.kind = transport::SenderKind::shm;
    sample.sender.number = static_cast<std::uint32_t>(slot_);
    sample.origin = transport::origin_of({wire::Encoding::binary, link_.read_in()});
    if (attachment_.overwritten != link_.overwritten()) {
      attachment_.overwritten = link_.overwritten();
      published_.store(attachment_);
    }
    if (met == ReadResult::malformed) {
      next_look_ = Clock::now() + malformed_period;
      return malformed();
    }
    if (is_constants) {
      sample.record = constants_;
    } else {
      sample.record = params_;
    }
    return CountedSource::sample(sample);
  }

  void complete(transport::SourceStatistics& statistics) const override {
    const Attachment attachment = published_.load();
    statistics.overwritten = attachment.overwritten;
    statistics.reattached = attachment.attached > 0 ? attachment.attached - 1 : 0;
    if (statistics.state == SourceState::failed) return;
    if (attachment.absent) {
      statistics.state = is_absence(attachment.why.problem) ? SourceState::waiting : SourceState::nothing_valid;
      statistics.waiting_for = describe(attachment.why);
    } else if (statistics.records == 0) {
      statistics.waiting_for = "slot " + std::to_string(slot_) + ": attached, nothing written yet";
      if (attachment.has_32_bit_program) {
        statistics.waiting_for += "; a 32-bit program is attached, whose records cannot be read";
      }
    }
  }

  const int slot_;
  Link link_;
  Sleeper sleeper_;
  Cadence cadence_{0};
  Clock::time_point look_until_{};  // polls for a writer that does not wake readers
  Clock::time_point next_look_{};   // no read before this time
  wire::CameraParams params_;
  wire::CameraConstants constants_;
  Attachment attachment_;
  base::Snapshot<Attachment> published_;
};

}  // namespace

std::unique_ptr<transport::Source> open_source(const Settings& settings) {
  return std::make_unique<ShmSource>(settings);
}

}  // namespace trk_bridge::shm
