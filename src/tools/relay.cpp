#include "relay.h"

#include <map>
#include <ostream>
#include <utility>
#include <variant>

#include "fan_out.h"
#include "cli/listen.h"
#include "cli/tally.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::tools {
namespace {

class Relay final : public cli::Listener {
 public:
  Relay(std::vector<std::unique_ptr<transport::Sink>> sinks, const RelayOptions& options, std::ostream& err)
      : options_(options), err_(err), sinks_(std::move(sinks), "trk", err) {}

  bool on_sample(const transport::Sample& sample) override {
    tally_.add(sample);
    std::visit([this](const auto& record) { pass_on(record); }, sample.record);
    return true;
  }

  void on_malformed(const transport::Reception& reception) override {
    if (malformed_[reception.fault.name()]++ != 0) return;
    err_ << "trk: malformed record from " << transport::to_string(reception.sample.sender) << ": "
         << describe(reception.fault) << " (told once)\n";
  }

  cli::ExitCode finish(const transport::SourceStatistics& source, cli::Ending ending) {
    sinks_.close();
    tally_.summarise(source, err_);
    sinks_.summarise();
    for (const auto& [reason, times] : refused_) {
      err_ << "trk: not passed on: " << times << " records: " << camera::describe(reason) << '\n';
    }
    if (crowded_ != 0) err_ << "trk: not passed on: " << crowded_ << " constants of ids beyond " << most_ids << '\n';
    if (ending == cli::Ending::failed) err_ << "trk: error: " << source.error << '\n';
    const bool is_good = sinks_.is_good() && refused_.empty() && crowded_ == 0 && ending != cli::Ending::failed;
    return is_good ? cli::exit_good : cli::exit_failed;
  }

 private:
  struct Constants {
    wire::CameraConstants incoming, outgoing;
  };

  void pass_on(const wire::CameraConstants& incoming) {
    if (options_.format) {
      if (const auto sound = camera::check(incoming); !sound) {
        // Those that came before do not count any more.
        known_.erase(incoming.id);
        return refuse(incoming.id, sound.error());
      }
    }
    wire::CameraConstants outgoing = options_.format ? camera::constants_for(incoming, *options_.format) : incoming;
    if (options_.id) outgoing.id = *options_.id;
    if (!remember(incoming, outgoing)) return;
    sinks_.write(outgoing);
  }

  void pass_on(const wire::CameraParams& incoming) {
    wire::CameraParams outgoing = incoming;
    if (options_.format) {
      const auto known = known_.find(incoming.id);
      const bool is_known = known != known_.end();
      const auto told = camera::reexpress(incoming, *options_.format, is_known ? &known->second.incoming : nullptr,
                                          is_known ? &known->second.outgoing : nullptr);
      if (!told) return refuse(incoming.id, told.error());
      outgoing = *told;
    }
    if (options_.id) outgoing.id = *options_.id;
    sinks_.write(outgoing);
  }

  /// False when there are more ids than any studio has cameras: the network is not trusted with memory.
  bool remember(const wire::CameraConstants& incoming, const wire::CameraConstants& outgoing) {
    const auto known = known_.find(incoming.id);
    if (known != known_.end()) {
      known->second = {incoming, outgoing};
    } else if (known_.size() < most_ids) {
      known_.emplace(incoming.id, Constants{incoming, outgoing});
    } else {
      if (crowded_++ == 0) err_ << "trk: constants of more than " << most_ids << " ids came; no more are taken\n";
      return false;
    }
    return true;
  }

  void refuse(std::uint32_t id, camera::CameraReason reason) {
    if (refused_[reason]++ != 0) return;
    err_ << "trk: id " << id << ": cannot be passed on as \"" << wire::format_to_words(*options_.format)
         << "\": " << camera::describe(reason) << " (told once)\n";
  }

  static constexpr std::size_t most_ids = 256;

  const RelayOptions options_;
  std::ostream& err_;
  FanOut sinks_;
  cli::Tally tally_;
  std::map<std::uint32_t, Constants> known_;
  std::map<camera::CameraReason, std::uint64_t> refused_;
  std::map<std::string_view, std::uint64_t> malformed_;
  std::uint64_t crowded_ = 0;
};

}  // namespace

cli::ExitCode relay(transport::Source& source, std::vector<std::unique_ptr<transport::Sink>> sinks,
               const RelayOptions& options, std::ostream& err) {
  Relay relay(std::move(sinks), options, err);
  const cli::Ending ending = cli::listen(source, relay);
  return relay.finish(source.statistics(), ending);
}

}  // namespace trk_bridge::tools
