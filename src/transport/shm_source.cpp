#include <algorithm>
#include <cerrno>
#include <system_error>

#include <poll.h>

#include "backends.h"
#include "stop_event.h"
#include "trk_bridge/transport/shm_link.h"
#include "trk_bridge/transport/snapshot.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::transport {
namespace {

using Clock = ShmLink::Clock;
using std::chrono::nanoseconds;

// How late a record is seen at most. Nothing wakes a reader of shared memory, so it has to look.
constexpr nanoseconds poll_period = std::chrono::microseconds(250);

std::int64_t wall_now() {
  return std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

struct Counts {
  std::uint64_t records = 0, malformed = 0, overwritten = 0, unknown_format_bits = 0, attached = 0;
  bool absent = true;
  ShmFault why{ShmProblem::no_file};
  int error = 0;  // errno
};

/// Looks for a segment until there is one, then polls its counters.
class ShmSource final : public Source {
 public:
  explicit ShmSource(const ShmEndpoint& endpoint)
      : slot_(endpoint.slot), link_(ShmLink::Options{endpoint.slot, nullptr, endpoint.mode, false}) {
    counts_.why.slot = slot_;
    if (slot_ < 0 || slot_ >= shm_slots) throw TransportError("shm " + describe({ShmProblem::bad_slot, slot_}));
    published_.store(counts_);
    keep(Clock::now());
  }

  Event receive(Reception& into, nanoseconds wait) override {
    if (counts_.error != 0) return Event::failed;
    const auto begin = Clock::now();
    for (auto now = begin;; now = Clock::now()) {
      if (stop_.is_set()) return Event::stopped;
      keep(now);
      if (const Event event = look(into); event != Event::idle) return event;
      const bool endless = wait < nanoseconds::zero();
      // As a difference, for `begin + wait` may be past what the clock can tell.
      const nanoseconds left = endless ? nanoseconds::max() : wait - (Clock::now() - begin);
      if (left <= nanoseconds::zero()) return Event::idle;
      const nanoseconds period = link_.segment() != nullptr ? poll_period : nanoseconds(ShmLink::attach_period);
      if (!pause(std::min(left, period))) return Event::failed;
    }
  }

  void stop() noexcept override { stop_.set(); }

  SourceStatistics statistics() const override {
    const Counts counts = published_.load();
    SourceStatistics s;
    s.records = counts.records;
    s.malformed = counts.malformed;
    s.overwritten = counts.overwritten;
    s.unknown_format_bits = counts.unknown_format_bits;
    s.reattached = counts.attached > 0 ? counts.attached - 1 : 0;
    if (counts.error != 0) {
      s.state = SourceState::failed;
      s.error = name() + ": waiting failed: " + std::generic_category().message(counts.error);
    } else if (counts.absent) {
      s.state = is_absence(counts.why.problem) ? SourceState::waiting : SourceState::nothing_valid;
      s.waiting_for = describe(counts.why);
    } else if (counts.records > 0) {
      s.state = SourceState::receiving;
    } else {
      s.state = counts.malformed > 0 ? SourceState::nothing_valid : SourceState::waiting;
      s.waiting_for = "slot " + std::to_string(slot_) + ": attached, nothing written yet";
    }
    return s;
  }

  std::string name() const override { return "shm slot " + std::to_string(slot_); }

 private:
  void keep(Clock::time_point now) {
    const auto kept = link_.keep(now);
    const bool changed = counts_.absent == kept.has_value() || counts_.attached != link_.attached() ||
                         (!kept && !(counts_.why == kept.error()));
    if (!changed) return;
    counts_.absent = !kept;
    if (!kept) counts_.why = kept.error();
    counts_.attached = link_.attached();
    published_.store(counts_);
  }

  /// Constants first: what follows is understood by them.
  Event look(Reception& into) {
    const ShmSegment* segment = link_.segment();
    if (segment == nullptr) return Event::idle;
    ShmRead met = link_.read(constants_, into.fault);
    const bool is_constants = met != ShmRead::nothing;
    if (!is_constants) met = link_.read(params_, into.fault);
    if (met == ShmRead::nothing) return Event::idle;
    Sample& sample = into.sample;
    sample.arrival = wall_now();
    sample.sender = {};
    sample.sender.kind = SenderKind::shm;
    sample.sender.number = static_cast<std::uint32_t>(slot_);
    sample.form = {wire::Encoding::binary, segment->layout().record};
    counts_.overwritten = link_.overwritten();
    if (met == ShmRead::malformed) {
      ++counts_.malformed;
    } else {
      ++counts_.records;
      if (is_constants) {
        sample.record = constants_;
      } else {
        sample.record = params_;
        if ((params_.format & ~wire::known_format_bits) != 0) ++counts_.unknown_format_bits;
      }
    }
    published_.store(counts_);
    return met == ShmRead::malformed ? Event::malformed : Event::sample;
  }

  bool pause(nanoseconds time) {
    const timespec timeout{static_cast<time_t>(time.count() / 1'000'000'000),
                           static_cast<long>(time.count() % 1'000'000'000)};
    pollfd stopped{stop_.fd(), POLLIN, 0};
    if (::ppoll(&stopped, 1, &timeout, nullptr) >= 0 || errno == EINTR) return true;
    counts_.error = errno;
    published_.store(counts_);
    return false;
  }

  const int slot_;
  ShmLink link_;
  StopEvent stop_;
  wire::CameraParams params_;
  wire::CameraConstants constants_;
  Counts counts_;
  Snapshot<Counts> published_;
};

}  // namespace

std::unique_ptr<Source> open_shm_source(const ShmEndpoint& endpoint) { return std::make_unique<ShmSource>(endpoint); }

}  // namespace trk_bridge::transport
