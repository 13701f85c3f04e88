// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Like a nodelet's library: loaded, used, and unloaded while a sink does not respond.
#include <cerrno>
#include <memory>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "bridge/outlet.h"
#include "udp.h"

namespace trk_bridge::test {
namespace {

/// A byte for each record.
class FifoSink final : public transport::Sink {
 public:
  explicit FifoSink(const std::string& path) : fd_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {}
  ~FifoSink() override { ::close(fd_); }
  std::string name() const override { return "fifo"; }

 private:
  transport::WriteResult put_byte() const {
    const char byte = 'x';
    if (::write(fd_, &byte, 1) == 1) return {};
    return tl::unexpected(transport::SinkFault{transport::SinkReason::system, {}, errno});
  }
  transport::WriteResult put(const wire::CameraParams&) override { return put_byte(); }
  transport::WriteResult put(const wire::CameraConstants&) override { return put_byte(); }
  transport::WriteResult finish() override { return {}; }

  const int fd_;
};

}  // namespace
}  // namespace trk_bridge::test

using namespace trk_bridge;

/// Writes more records to a FIFO than it accepts, and abandons it. False if that did not happen.
extern "C" bool leave_stuck(const char* fifo, int records) {
  transport::SinkEndpoint endpoint;
  endpoint.blocking = transport::Blocking::storage;
  endpoint.open = [fifo] { return std::make_unique<test::FifoSink>(fifo); };
  bridge::Outlet outlet(endpoint, {});
  for (int i = 0; i < records; ++i) outlet.write(test::params(1));
  const auto closed = outlet.close();
  return !closed && closed.error().reason == transport::SinkReason::no_answer;
}
