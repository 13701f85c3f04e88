// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A sink whose writes wait for the test's permission, like a slow disk or segment.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "deadline.h"
#include "trk_bridge/transport/endpoint.h"

namespace trk_bridge::test {

/// What a controlled sink has received, and whether it may continue. Any thread.
class SinkControl {
 public:
  /// From now on writes return.
  void open() {
    change([&] { open_ = true; });
  }
  void set_fault(const std::optional<transport::SinkFault>& fault) {
    change([&] { fault_ = fault; });
  }

  /// From now on opening blocks until it is permitted.
  void block_opening() {
    change([&] { may_open_ = false; });
  }
  void permit_opening() {
    change([&] { may_open_ = true; });
  }
  /// Why opening fails; empty: it succeeds.
  void set_opening_error(const std::string& error) {
    change([&] { opening_error_ = error; });
  }
  /// Every write takes this long.
  void set_delay(std::chrono::milliseconds delay) {
    change([&] { delay_ = delay; });
  }

  /// Whether this many attempts to open it have been made within the deadline.
  bool was_tried(int times) {
    return becomes([&] { return attempts_ >= times; });
  }
  /// Whether it is closed within the deadline.
  bool closes() {
    return becomes([&] { return closed_; });
  }
  /// Whether at least this many records were written within the deadline.
  bool has_written(std::size_t count) {
    return becomes([&] { return records_.size() >= count; });
  }
  /// Whether a write waits for permission.
  bool is_blocking() {
    return becomes([&] { return waiting_; });
  }
  std::size_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return records_.size();
  }
  std::vector<wire::Record> records() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return records_;
  }
  std::vector<wire::CameraParams> params() const { return all<wire::CameraParams>(); }
  std::vector<wire::CameraConstants> constants() const { return all<wire::CameraConstants>(); }
  bool is_closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }

  void prepare() {
    std::unique_lock<std::mutex> lock(mutex_);
    ++attempts_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return may_open_; });
    if (!opening_error_.empty()) throw transport::TransportError(opening_error_);
  }
  transport::WriteResult write(const wire::Record& record) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (delay_ > delay_.zero()) {
      const auto delay = delay_;
      lock.unlock();
      std::this_thread::sleep_for(delay);
      lock.lock();
    }
    waiting_ = true;
    changed_.notify_all();
    changed_.wait(lock, [&] { return open_; });
    waiting_ = false;
    if (fault_) return tl::unexpected(*fault_);
    records_.push_back(record);
    changed_.notify_all();
    return {};
  }
  void close() {
    change([&] { closed_ = true; });
  }

 private:
  template <typename Action>
  void change(const Action& action) {
    const std::lock_guard<std::mutex> lock(mutex_);
    action();
    changed_.notify_all();
  }
  template <typename Condition>
  bool becomes(const Condition& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, deadline, condition);
  }
  template <typename Record>
  std::vector<Record> all() const {
    std::vector<Record> found;
    for (const auto& record : records()) {
      if (const auto* one = std::get_if<Record>(&record)) found.push_back(*one);
    }
    return found;
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false, waiting_ = false, closed_ = false, may_open_ = true;
  int attempts_ = 0;
  std::string opening_error_;
  std::chrono::milliseconds delay_{0};
  std::optional<transport::SinkFault> fault_;
  std::vector<wire::Record> records_;
};

class ControlledSink final : public transport::Sink {
 public:
  ControlledSink(std::shared_ptr<SinkControl> control, std::string name)
      : control_(std::move(control)), name_(std::move(name)) {}
  /// The control outlives the sink.
  ControlledSink(SinkControl& control, std::string name)
      : ControlledSink(std::shared_ptr<SinkControl>(&control, [](SinkControl*) {}), std::move(name)) {}
  std::string name() const override { return name_; }

 private:
  void get_ready() override { control_->prepare(); }
  transport::WriteResult put(const wire::CameraParams& params) override { return control_->write(params); }
  transport::WriteResult put(const wire::CameraConstants& constants) override { return control_->write(constants); }
  transport::WriteResult finish() override {
    control_->close();
    return {};
  }

  const std::shared_ptr<SinkControl> control_;
  const std::string name_;
};

/// An endpoint whose sinks share the control: they may outlive the caller's pointer.
inline transport::SinkEndpoint endpoint_of(const std::shared_ptr<SinkControl>& control,
                                           transport::Blocking blocking = transport::Blocking::never,
                                           const transport::SinkForm& form = {}, const std::string& name = "control") {
  transport::SinkEndpoint endpoint;
  endpoint.url = "test:" + name;
  endpoint.form = form;
  endpoint.blocking = blocking;
  endpoint.open = [control, name] { return std::make_unique<ControlledSink>(control, name); };
  return endpoint;
}
/// An endpoint of a control that outlives the sinks that are opened.
inline transport::SinkEndpoint endpoint_of(SinkControl& control,
                                           transport::Blocking blocking = transport::Blocking::never,
                                           const transport::SinkForm& form = {}, const std::string& name = "control") {
  return endpoint_of(std::shared_ptr<SinkControl>(&control, [](SinkControl*) {}), blocking, form, name);
}

}  // namespace trk_bridge::test
