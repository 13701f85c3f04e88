// Several sinks as one: what one of them refuses does not keep the others from it, and none waits for another.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bridge/departures.h"
#include "bridge/outlet.h"

namespace trk_bridge::tools {

/// Reports each cause of a loss once, in the thread that met it, and counts. Its functions are for one thread at a
/// time.
class FanOut {
 public:
  /// `may_wait`: see OutletOptions.
  explicit FanOut(std::ostream& err, std::function<bool()> may_wait = {}) : err_(err), may_wait_(std::move(may_wait)) {}

  /// Opens one more. `defaults` count for what the endpoint does not say. Throws TransportError; a sink with a delay or
  /// a lead needs a source that is live, and is refused where it may wait.
  void add(const transport::SinkEndpoint&, const transport::SinkForm& defaults);

  /// Sinks are added before.
  void write(const wire::CameraParams&, const transport::RecordTime& time = {});
  void write(const wire::CameraConstants&);
  /// Writes what is queued or delayed and closes all, at the same time.
  void close();

  /// A line on `err`, whole whatever other threads report. Any thread.
  void report(const std::string& line);
  /// Once it is closed, whether every sink took everything. That a file left out what came before its constants, that a
  /// FIFO left out what came before its reader, and that shared memory left out sets that newer ones replaced is
  /// reported and counted, but is no failure.
  bool is_good() const noexcept { return is_good_; }
  /// Once it is closed: what was sent, a line a sink, and how often each cause came.
  void summarise() const;
  /// Once it is closed, for what else is to be written there.
  std::ostream& err() const noexcept { return err_; }

  const std::vector<std::unique_ptr<bridge::Outlet>>& outlets() const noexcept { return outlets_; }

 private:
  using Cause = std::pair<std::size_t, bridge::Loss::Cause>;  // which sink, and why

  void count(std::size_t sink, const bridge::Loss&);
  bridge::Departures& departures();

  std::ostream& err_;
  const std::function<bool()> may_wait_;
  std::mutex mutex_;  // of err_, causes_ and is_good_ until it is closed
  std::map<Cause, std::uint64_t> causes_;
  bool is_good_ = true;
  std::vector<std::unique_ptr<bridge::Outlet>> outlets_;
  std::optional<bridge::Departures> departures_;  // once something is written
};

}  // namespace trk_bridge::tools
