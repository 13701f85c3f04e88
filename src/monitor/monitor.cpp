#include "monitor.h"

#include <algorithm>
#include <chrono>
#include <ostream>

#include <unistd.h>

#include "base/clock.h"
#include "base/time_text.h"
#include "cli/checked_output.h"
#include "cli/listen.h"
#include "cli/stop_signals.h"
#include "model.h"
#include "screen.h"
#include "view.h"

namespace trk_bridge::monitor {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double screen_period = 0.1;  // s
constexpr double lines_period = 1.0;   // s

/// The model, fed from a source for as long as the user wants.
class Watch final : public cli::Listener {
 public:
  Watch(transport::Source& source, std::optional<double> seconds)
      : source_(source), seconds_(seconds), begin_(Clock::now()) {}

  bool on_sample(const transport::Sample& sample) override {
    model_.add(sample, Clock::now());
    return true;
  }
  void on_malformed(const transport::Reception& reception) override { model_.add_malformed(reception, Clock::now()); }

  /// Listens for `period` seconds, less when the time limit is nearer. Whether there is more to come.
  bool go_on(double period) {
    ending_ = cli::listen(source_, *this, std::min(period, std::max(0.0, left())));
    return ending_ == cli::Ending::enough && left() > 0;
  }
  /// To the end of the time limit, in seconds.
  double left() const {
    const double passed = std::chrono::duration<double>(Clock::now() - begin_).count();
    return seconds_.value_or(passed + 1e9) - passed;
  }
  bool has_ended() const { return ending_ == cli::Ending::ended; }
  State state() const { return model_.state(Clock::now(), source_); }

  cli::ExitCode finish(std::ostream& err) const {
    return cli::report_end(model_.tally(), source_.statistics(), ending_, err);
  }

 private:
  transport::Source& source_;
  const std::optional<double> seconds_;
  const Clock::time_point begin_;
  Model model_;
  cli::Ending ending_ = cli::Ending::enough;
};

/// What is shown stays until the user has seen it.
void stay(Screen& screen, const Watch& watch) {
  const std::chrono::milliseconds wait(static_cast<int>(screen_period * 1000));
  while (!cli::StopSignals::stopped() && watch.left() > 0 && screen.key(wait) != Screen::Key::quit) {
    screen.show(screen_of(watch.state(), screen.size()));
  }
}

void watch_on_screen(Watch& watch) {
  Screen screen;
  do {
    for (auto key = screen.key({}); key != Screen::Key::none; key = screen.key({})) {
      if (key == Screen::Key::quit) return;
    }
    screen.show(screen_of(watch.state(), screen.size()));
  } while (watch.go_on(screen_period));
  // Nobody could end it by a key otherwise.
  if (watch.has_ended() && ::isatty(STDIN_FILENO) != 0) stay(screen, watch);
}

}  // namespace

cli::ExitCode show_on_screen(transport::Source& source, std::optional<double> seconds, std::ostream& err) {
  Watch watch(source, seconds);
  watch_on_screen(watch);
  return watch.finish(err);
}

cli::ExitCode show_in_lines(transport::Source& source, std::optional<double> seconds, std::ostream& out,
                            std::ostream& err) {
  Watch watch(source, seconds);
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
