// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <chrono>
#include <mutex>
#include <utility>

#include <unistd.h>

#include "base/clock.h"
#include "scheme.h"
#include "take_writer.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {
namespace {

using std::chrono::steady_clock;
using transport::refused;
using transport::refused_by_system;
using transport::SinkFault;
using transport::SinkReason;
using transport::TransportError;
using transport::WriteResult;

/// How often writes try again to open a file that could not be opened. A reader of a FIFO should not miss much.
constexpr std::chrono::milliseconds retry_period{1000}, reader_retry_period{100};
constexpr std::int64_t day = 86'400'000'000'000;  // ns

class FileSink final : public transport::Sink {
 public:
  explicit FileSink(const SinkSettings& settings) : settings_(settings), name_("file " + settings.path.shown()) {}

  std::string name() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return name_;
  }
  std::string notice() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return waits_ ? describe(SinkFault{SinkReason::no_reader}) + " yet" : notice_;
  }

 private:
  void get_ready() override;
  WriteResult put(const wire::CameraParams&) override;
  WriteResult put(const wire::CameraConstants& constants) override { return writer_.write(constants); }
  WriteResult finish() override;

  /// Called before the first field, whose time this is. Cannot fail: every allowed rate has a code for every time of
  /// the day.
  void set_time_code(std::int64_t time, const std::optional<base::TimeCodeWithRate>& of_source = {}) {
    const auto of_day = [&] { return *base::time_code_at(time % day, settings_.rate); };
    writer_.set_time_code(settings_.time_code ? *settings_.time_code : of_source ? of_source->code : of_day());
  }
  WriteResult open(std::int64_t time);
  /// open(), and when to try again.
  void try_to_open(std::int64_t time);
  WriteResult open_when_due(std::int64_t time);
  /// Publishes unfinished takes of dead writers, and reports them in notice().
  void recover();

  const SinkSettings settings_;
  TakeWriter writer_;
  WriteResult opened_;  // the last attempt
  steady_clock::time_point next_attempt_{};
  mutable std::mutex mutex_;  // protects the following members
  std::string name_;
  std::string notice_;
  bool waits_ = false;  // waits for a reader
};

void FileSink::recover() {
  std::string notice;
  for (const auto& name : recover_parts(settings_.path, settings_.number)) {
    notice += (notice.empty() ? "recovered from an interrupted recording: " : ", ") + name;
  }
  if (notice.empty()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  notice_ = notice;
}

WriteResult FileSink::open(std::int64_t time) {
  recover();
  const std::string path = settings_.path.at(time);
  auto file = path.empty()       ? OpenedFile(refused_by_system(ENAMETOOLONG))
              : settings_.number ? open_next_number(path)
                                 : PartFile::open(path, {settings_.overwrite, Fifo::allowed});
  if (!file) return tl::unexpected(file.error());
  const std::string name = "file " + file->path();
  if (auto begun = writer_.open(*std::move(file)); !begun) return begun;
  const std::lock_guard<std::mutex> lock(mutex_);
  name_ = name;
  waits_ = false;
  return {};
}

void FileSink::try_to_open(std::int64_t time) {
  opened_ = open(time);
  const bool is_unread = !opened_ && opened_.error().reason == SinkReason::no_reader;
  next_attempt_ = steady_clock::now() + (is_unread ? reader_retry_period : retry_period);
}

WriteResult FileSink::open_when_due(std::int64_t time) {
  if (opened_ || steady_clock::now() >= next_attempt_) try_to_open(time);
  return opened_;
}

void FileSink::get_ready() {
  if (writer_.is_open()) return;
  const std::int64_t now = base::wall_now();
  if (settings_.path.has_time()) {
    // The name depends on the first field: only the directory can be checked before.
    recover();
    const std::string directory = directory_of(settings_.path.at(now));
    opened_ = {};
    if (::access(directory.c_str(), W_OK | X_OK) != 0) {
      opened_ = refused_by_system(errno);
    }
  } else {
    try_to_open(now);
  }
  if (opened_) return;
  if (opened_.error().reason == SinkReason::no_reader) {
    // The reader may come later.
    const std::lock_guard<std::mutex> lock(mutex_);
    waits_ = true;
    return;
  }
  throw TransportError(settings_.path.shown() + ": cannot be written: " + describe(opened_.error()));
}

WriteResult FileSink::put(const wire::CameraParams& params) {
  if (!writer_.has_constants()) return refused(SinkReason::no_constants);
  const std::int64_t time = this->time().nanoseconds > 0 ? this->time().nanoseconds : base::wall_now();
  if (!writer_.is_open()) {
    if (auto opened = open_when_due(time); !opened) return opened;
  }
  if (!writer_.has_fields()) set_time_code(time, this->time().time_code);
  return writer_.write(params);
}

WriteResult FileSink::finish() {
  if (!writer_.is_open()) {
    if (!opened_) return opened_;
    if (!writer_.has_constants()) return refused(SinkReason::no_constants);
    return {};
  }
  if (!writer_.has_fields()) set_time_code(base::wall_now());
  return writer_.close();
}

}  // namespace

std::unique_ptr<transport::Sink> open_sink(const SinkSettings& settings) {
  return std::make_unique<FileSink>(settings);
}

}  // namespace trk_bridge::file
