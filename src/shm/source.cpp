#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <string>

#include "base/clock.h"
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

// How late a record is seen at most. Nothing wakes a reader of shared memory, so it has to look.
// A segment full of what is no record is not looked at more often either.
constexpr nanoseconds poll_period = std::chrono::microseconds(250);

/// Whether a segment is attached.
struct Attachment {
  std::uint64_t attached = 0, overwritten = 0;
  bool absent = true;
  bool has_32_bit_program = false;
  SlotFault why{SlotProblem::no_file};
};

/// Looks for a segment until there is one, then polls its counters.
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

  Event receive(transport::Reception& into, nanoseconds wait) override {
    const auto begin = Clock::now();
    for (auto now = begin;; now = Clock::now()) {
      if (const Event end = final_event(); end != Event::sample) return end;
      keep(now);
      if (now >= next_look_) {
        if (const Event event = look(into); event != Event::idle) return event;
      }
      const bool endless = wait < nanoseconds::zero();
      // As a difference, for `begin + wait` may be past what the clock can represent.
      const nanoseconds left = endless ? nanoseconds::max() : wait - (Clock::now() - begin);
      if (left <= nanoseconds::zero()) return Event::idle;
      const nanoseconds period = link_.segment() != nullptr ? poll_period : nanoseconds(Link::attach_period);
      // A stop is seen above.
      const transport::Deadline next_look(std::min(left, period));
      if (transport::wait_readable(transport::no_descriptor, stop_event(), next_look) == transport::Wake::failed) {
        return failed(errno);
      }
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
    attachment_.absent = !kept;
    if (!kept) attachment_.why = kept.error();
    attachment_.attached = link_.attached();
    attachment_.has_32_bit_program = has_32_bit_program;
    published_.store(attachment_);
  }

  /// Constants first: what follows is understood by them.
  Event look(transport::Reception& into) {
    if (link_.segment() == nullptr) return Event::idle;
    ReadResult met = link_.read(constants_, into.fault);
    const bool is_constants = met != ReadResult::nothing;
    if (!is_constants) met = link_.read(params_, into.fault);
    if (met == ReadResult::nothing) return Event::idle;
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
      next_look_ = Clock::now() + poll_period;
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
        statistics.waiting_for += "; a 32-bit program is attached, and what it writes cannot be found";
      }
    }
  }

  const int slot_;
  Link link_;
  Clock::time_point next_look_{};
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
