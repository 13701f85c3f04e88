// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <ostream>
#include <utility>

#include <unistd.h>

#include "axis_check.h"
#include "base/clock.h"
#include "base/time_text.h"
#include "cli/checked_output.h"
#include "cli/listen.h"
#include "cli/stop_signals.h"
#include "model.h"
#include "recording.h"
#include "screen.h"
#include "view.h"

namespace trk_bridge::monitor {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double screen_period = 0.1;  // s
constexpr double lines_period = 1.0;   // s

/// Receives from a source and updates the model.
class Watch final : public cli::Listener {
 public:
  Watch(transport::Source& source, const Options& options)
      : source_(source), options_(options), begin_(Clock::now()), model_(begin_, source.statistics()) {}

  bool on_sample(const transport::Sample& sample) override {
    tally_.add(sample);
    model_.add(sample, Clock::now());
    recording.add(sample);
    return true;
  }
  void on_malformed(const transport::Reception& reception) override { model_.add_malformed(reception, Clock::now()); }

  /// Listens for `period` seconds, or until the time limit. Returns whether there may be more records.
  bool go_on(double period) {
    ending_ = cli::listen(source_, *this, std::min(period, std::max(0.0, left())));
    return ending_ == cli::Ending::enough && left() > 0;
  }
  /// Time until the time limit, s.
  double left() const {
    const double passed = std::chrono::duration<double>(Clock::now() - begin_).count();
    return options_.seconds.value_or(passed + 1e9) - passed;
  }
  bool has_ended() const { return ending_ == cli::Ending::ended; }
  void reset() { model_ = Model(Clock::now(), source_.statistics()); }

  /// The state, with the alarms as first findings.
  State state() {
    auto state = model_.state(Clock::now(), source_);
    auto alarms = raised(options_.alarms, state);
    is_new_alarm_ = alarms.size() > alarms_;
    alarms_ = alarms.size();
    was_alarmed_ = was_alarmed_ || alarms_ > 0;
    state.findings.insert(state.findings.begin(), std::make_move_iterator(alarms.begin()),
                          std::make_move_iterator(alarms.end()));
    return state;
  }
  /// The last state() raised an alarm that was not raised before.
  bool is_new_alarm() const { return is_new_alarm_; }

  cli::ExitCode finish(std::ostream& err) {
    if (recording.is_on()) err << "trk: " << recording.end() << '\n';
    const auto ended = cli::report_end(tally_, source_.statistics(), ending_, /*has_limit=*/false, err);
    return ended == cli::exit_good && was_alarmed_ ? cli::exit_alarm : ended;
  }

  Recording recording;

 private:
  transport::Source& source_;
  const Options& options_;
  const Clock::time_point begin_;
  cli::Tally tally_;
  Model model_;
  std::size_t alarms_ = 0;
  bool is_new_alarm_ = false, was_alarmed_ = false;
  cli::Ending ending_ = cli::Ending::enough;
};

std::optional<PoseNumbers> pose_of(const State& state, const Choice& choice) {
  if (state.cameras.empty()) return {};
  const auto& latest = state.cameras[chosen(state, choice)].latest;
  if (!latest || latest->is_silent || !latest->pose) return {};
  const auto angles = camera::pan_tilt_roll(latest->pose->linear());
  const auto& at = latest->pose->translation();
  return PoseNumbers{at.x(), at.y(), at.z(), angles.pan, angles.tilt, angles.roll};
}

/// The screen and its keys.
class Session {
 public:
  explicit Session(Watch& watch) : watch_(watch) {}

  /// Runs until the user quits or the source ends.
  void run() {
    constexpr std::chrono::milliseconds no_wait{0}, period{static_cast<int>(screen_period * 1000)};
    for (bool has_more = true;;) {
      for (auto key = screen_.key(has_more ? no_wait : period); key; key = screen_.key(no_wait)) {
        if (*key == 'q' || *key == 'Q') return;
        on_key(*key);
      }
      draw();
      if (has_more) has_more = watch_.go_on(screen_period);
      // After the source has ended, the screen stays until the user quits, which needs a keyboard.
      const bool stays = watch_.has_ended() && ::isatty(STDIN_FILENO) != 0;
      if (!has_more && (!stays || cli::StopSignals::stopped() || watch_.left() <= 0)) return;
    }
  }

 private:
  void draw() {
    live_ = watch_.state();
    if (watch_.is_new_alarm()) screen_.ring();
    axis_check_.look(pose_of(live_, choice_));
    choice_.guide = axis_check_.lines();
    choice_.is_paused = paused_.has_value();
    const std::string recording = watch_.recording.status();
    if (!recording.empty()) choice_.notice = recording;
    screen_.show(shows_help_ ? help_screen(screen_.size()) : screen_of(shown(), choice_, screen_.size()));
  }
  const State& shown() const { return paused_ ? *paused_ : live_; }

  void on_key(char key) {
    if (key == '\0') return;
    choice_.notice.clear();
    if (std::exchange(shows_help_, false)) return;
    switch (key) {
      case '?':
      case 'h':
        shows_help_ = true;
        break;
      case 'p':
        paused_ = paused_ ? std::nullopt : std::optional(frozen(live_));
        break;
      case 'r':
        watch_.reset();
        paused_.reset();
        choice_.notice = "reset";
        break;
      case 'n':
        choose(1);
        break;
      case 'N':
        choose(-1);
        break;
      case 'v':
        plot(1);
        break;
      case 'V':
        plot(-1);
        break;
      case 't':
        choice_.seconds = choice_.seconds == 10 ? 30 : choice_.seconds == 30 ? 60 : 10;
        break;
      case 'R':
        record();
        break;
      case 'a':
        axis_check_.is_on() ? axis_check_.end() : axis_check_.begin(pose_of(live_, choice_));
        break;
      case ' ':
        axis_check_.next(pose_of(live_, choice_));
        break;
      default:
        choice_.notice = "unknown key; ? shows all keys";
    }
  }
  void choose(int by) {
    const auto& cameras = shown().cameras;
    if (cameras.empty()) return;
    const std::size_t count = cameras.size();
    const std::size_t next = (chosen(shown(), choice_) + (by > 0 ? 1 : count - 1)) % count;
    choice_.camera = cameras[next].key;
  }
  void plot(int by) {
    const std::size_t next = static_cast<std::size_t>(choice_.plotted) + (by > 0 ? 1 : value_count - 1);
    choice_.plotted = static_cast<Value>(next % value_count);
  }
  void record() {
    if (watch_.recording.is_on()) {
      choice_.notice = watch_.recording.end();
    } else if (live_.cameras.empty()) {
      choice_.notice = "not recorded: no camera received yet";
    } else {
      choice_.notice = watch_.recording.begin(live_.cameras[chosen(live_, choice_)]);
    }
  }

  Watch& watch_;
  Screen screen_;
  Choice choice_;
  AxisCheck axis_check_;
  State live_;
  std::optional<State> paused_;
  bool shows_help_ = false;
};

}  // namespace

cli::ExitCode show_on_screen(transport::Source& source, const Options& options, std::ostream& err) {
  Watch watch(source, options);
  Session(watch).run();
  return watch.finish(err);
}

cli::ExitCode show_in_lines(transport::Source& source, const Options& options, std::ostream& out, std::ostream& err) {
  Watch watch(source, options);
  cli::CheckedOutput lines(out);
  bool is_wanted = true;
  for (bool has_more = true; has_more && is_wanted;) {
    has_more = watch.go_on(lines_period);
    const std::string time = base::iso_time(base::wall_now());
    for (const auto& line : plain_lines_of(watch.state(), lines_period)) {
      is_wanted = lines.line(time + "  " + line, true) && is_wanted;
    }
  }
  const cli::ExitCode written = lines.finish(err);
  const cli::ExitCode watched = watch.finish(err);
  return written != cli::exit_good ? written : watched;
}

}  // namespace trk_bridge::monitor
