// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "relay.h"

#include <map>
#include <string_view>
#include <variant>

#include "cli/listen.h"
#include "cli/tally.h"
#include "trk_bridge/camera/camera.h"

namespace trk_bridge::tools {
namespace {

class Relay final : public cli::Listener {
 public:
  explicit Relay(FanOut& sinks) : sinks_(sinks) {}

  bool on_sample(const transport::Sample& sample) override {
    tally_.add(sample);
    if (!sample.has_lens) {
      note_without_lens(sample);
    } else if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) {
      sinks_.write(*params, {sample.arrival, sample.time_code});
    } else {
      sinks_.write(std::get<wire::CameraConstants>(sample.record));
    }
    return true;
  }

  void on_malformed(const transport::Reception& reception) override {
    if (malformed_[reception.fault.name()]++ != 0) return;
    sinks_.report("malformed record from " + transport::to_string(reception.sample.sender) + ": " +
                  describe(reception.fault) + " (reported once)");
  }

  cli::ExitCode finish(const transport::SourceStatistics& source, cli::Ending ending, bool has_limit) {
    sinks_.close(/*got_nothing=*/has_limit && tally_.received() == 0);
    const cli::ExitCode ended = cli::report_end(tally_, source, ending, has_limit, sinks_.err());
    sinks_.summarise();
    if (without_lens_ != 0) {
      sinks_.report("not passed on: " + std::to_string(without_lens_) +
                    " parameters: " + camera::describe(camera::CameraReason::no_lens));
    }
    return sinks_.is_good() && without_lens_ == 0 ? ended : cli::exit_failed;
  }

 private:
  /// Parameters without a lens are not passed on, because trk records need one.
  void note_without_lens(const transport::Sample& sample) {
    if (without_lens_++ != 0) return;
    const std::string why = *sample.doubt != '\0' ? sample.doubt : "set a lens table of the source (lens=FILE)";
    sinks_.report("parameters from " + transport::to_string(sample.sender) + " cannot be passed on: " +
                  camera::describe(camera::CameraReason::no_lens) + ": " + why + " (reported once)");
  }

  FanOut& sinks_;
  cli::Tally tally_;
  std::map<std::string_view, std::uint64_t> malformed_;
  std::uint64_t without_lens_ = 0;
};

}  // namespace

cli::ExitCode relay(transport::Source& source, FanOut& sinks, std::optional<double> seconds) {
  Relay relay(sinks);
  const cli::Ending ending = cli::listen(source, relay, seconds);
  return relay.finish(source.statistics(), ending, seconds.has_value());
}

}  // namespace trk_bridge::tools
