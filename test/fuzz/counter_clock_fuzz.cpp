// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any counters and arrivals, in any order: verdicts on counters, the line through arrivals, and stamps.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "bridge/counter_clock.h"
#include "bridge/stamper.h"
#include "fuzz.h"
#include "trk_bridge/base/sequence.h"

namespace {

using namespace trk_bridge;
using bridge::CounterClock;
using bridge::Stamper;
using test::claim;

constexpr std::int64_t begin = 1'700'000'000'000'000'000;

/// Any time since 1970 that leaves a second to the end of the numbers.
std::int64_t sum(std::int64_t time, std::int64_t by) {
  constexpr std::uint64_t end = std::numeric_limits<std::int64_t>::max() - 1'000'000'000;
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(time) + static_cast<std::uint64_t>(by)) % end);
}

/// One camera, and what holds for every sample of it.
class Camera {
 public:
  explicit Camera(base::CounterUse use) : sequence_(50, use) {}

  void take(std::uint64_t counter, std::int64_t arrival) {
    const auto accepted = sequence_.counts().accepted;
    const base::Order order = sequence_.classify(counter, counter);
    claim(sequence_.counts().accepted == accepted + (is_new(order) ? 1 : 0), "a verdict that is not counted");
    claim(order == base::Order::next || sequence_.step() == 0, "a step without a next one");
    if (!is_new(order)) return;

    const std::int64_t stamp = clock_.stamp(sequence_.step(), arrival);
    claim(stamp <= arrival, "a stamp after its arrival");
    claim(arrival - stamp <= static_cast<std::int64_t>(CounterClock::most_early), "a stamp that is too early");
    if (last_) {
      const bool has_room = arrival > *last_ && arrival - *last_ >= Stamper::least_step;
      claim(stamp > *last_ || stamp == arrival, "a stamp that goes back");
      claim(!has_room || stamp - *last_ >= Stamper::least_step, "a stamp that stands");
    }
    last_ = stamp;
    claim_statistics();
    claim_published(stamp);
  }

  void set_delay(std::chrono::nanoseconds delay) {
    delay_ = delay.count();
    stamper_.set_delay(delay);
  }
  void forget() {
    clock_.forget();
    sequence_.forget_newest();
  }
  const bridge::CounterClockStatistics& statistics() const { return clock_.statistics(); }

 private:
  void claim_statistics() const {
    const auto& s = clock_.statistics();
    for (const double number : {s.interval, s.jitter_before, s.jitter_after}) {
      claim(std::isfinite(number) && number >= 0, "a statistic that is no length of time");
    }
    claim(std::isfinite(s.last_step), "a step that is no time");
    claim(!s.learned || s.interval > 0, "learned without an interval");
  }

  void claim_published(std::int64_t time) {
    const auto steps = stamper_.steps();
    const auto stamp = stamper_.stamp(time);
    if (!stamp) return;
    claim(bridge::can_be_stamp(*stamp), "what cannot be a stamp");
    claim(*stamp - (time - delay_) <= Stamper::most_ahead + Stamper::least_step && *stamp >= time - delay_,
          "not near its time");
    claim(!published_ || *stamp > *published_ || stamper_.steps() > steps, "a published stamp that goes back");
    published_ = stamp;
  }

  base::Sequence sequence_;
  CounterClock clock_;
  Stamper stamper_{std::chrono::nanoseconds(0)};
  std::int64_t delay_ = 0;
  std::optional<std::int64_t> last_, published_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  test::Input input(data, size);
  const base::CounterUse uses[] = {base::CounterUse::strict, base::CounterUse::automatic, base::CounterUse::ignore};
  const base::CounterUse use = uses[input.below(3)];
  Camera camera(use);
  std::uint64_t counter = 0;
  std::int64_t arrival = begin;
  for (int samples = 0; !input.is_empty() && samples < 20'000;) {
    switch (input.below(6)) {
      case 0: {  // a rhythm, with jitter
        const int count = 20 * input.number<std::uint8_t>();
        const std::int64_t interval = input.number<std::uint32_t>() % 1'000'000'000;
        const std::uint64_t jitter = 1 + input.number<std::uint16_t>() * std::uint64_t{1000};
        const std::uint64_t step = input.below(4);
        for (int i = 0; i < count; ++i, ++samples) {
          counter += step;
          arrival = sum(arrival, interval);
          const std::uint64_t late = (counter * 7919 + static_cast<std::uint64_t>(i) * 104729) % jitter;
          camera.take(counter, sum(arrival, static_cast<std::int64_t>(late)));
        }
        break;
      }
      case 1:
        arrival = sum(arrival, input.number<std::int64_t>());
        break;
      case 2:
        counter = input.number<std::uint64_t>();
        break;
      case 3:  // one sample
        counter += static_cast<std::uint64_t>(input.number<std::int8_t>());
        arrival = sum(arrival, input.number<std::int32_t>());
        camera.take(counter, arrival);
        ++samples;
        break;
      case 4:
        camera.set_delay(std::chrono::nanoseconds(input.number<std::uint32_t>()));
        break;
      case 5:
        camera.forget();
        break;
    }
  }
  if (use == base::CounterUse::ignore) return 0;
  // Whatever came, a tracker of 50 Hz is learned.
  for (int i = 0; i < 6000; ++i) camera.take(++counter, begin + i * std::int64_t{20'000'000} + i % 3 * 300'000);
  claim(camera.statistics().learned, "a rhythm that is not learned");
  claim(std::abs(camera.statistics().interval - 20e6) < 20e3, "an interval that is wrong");
  return 0;
}
