// As a nodelet's library: loaded, used, and unloaded while a sink does not answer.
#include <memory>

#include "bridge/outlet.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "udp.h"

using namespace trk_bridge;

/// Writes to a FIFO until it is full, and leaves it to itself. False where that is not what happened.
extern "C" bool leave_stuck(const char* fifo) {
  bridge::Outlet outlet(endpoints::parse_sink(std::string("file:") + fifo).value(), {});
  outlet.write(test::constants());
  for (std::uint64_t counter = 1; counter <= 2000; ++counter) outlet.write(test::params(counter));
  const auto closed = outlet.close();
  return !closed && closed.error().reason == transport::SinkReason::no_answer;
}
