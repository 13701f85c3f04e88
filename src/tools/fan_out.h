// Several sinks as one: what one of them refuses does not keep the others from it.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trk_bridge/transport/sink.h"

namespace trk_bridge::tools {

/// Tells each cause of failure once, and counts. Not synchronised.
class FanOut {
 public:
  /// `program` begins every line written to `err`.
  FanOut(std::vector<std::unique_ptr<transport::Sink>>, std::string program, std::ostream& err);

  void write(const wire::CameraParams&);
  void write(const wire::CameraConstants&);
  void close();

  /// Whether every sink took everything. That a file left out what came before its constants is told and counted, but
  /// is no failure: a recording begins when it can.
  bool is_good() const noexcept { return is_good_; }
  /// What was sent, one line a sink, and how often each cause came.
  void summarise() const;

 private:
  using Cause = std::pair<std::size_t, transport::SinkFault>;  // which sink, and why

  template <typename Record>
  void write_each(const Record&);
  void count(std::size_t sink, const transport::SinkFault&);

  std::vector<std::unique_ptr<transport::Sink>> sinks_;
  std::string program_;
  std::ostream& err_;
  std::map<Cause, std::uint64_t> causes_;
  bool is_good_ = true;
};

}  // namespace trk_bridge::tools
