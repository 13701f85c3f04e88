// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "source_reader.h"

#include <algorithm>
#include <chrono>

#include "base/clock.h"

namespace trk_bridge::nodes {

SourceReader::SourceReader(std::unique_ptr<transport::Source> source, std::vector<CameraOutput*> cameras,
                           const ::ros::Publisher& tf)
    : source_(std::move(source)), cameras_(std::move(cameras)), tf_(tf) {
  ready_.reserve(cameras_.size());
}

SourceReader::~SourceReader() {
  source_->stop();
  if (thread_.joinable()) thread_.join();
}

void SourceReader::start() {
  thread_ = std::thread([this] { run(); });
}

bridge::CameraReport SourceReader::report() const {
  bridge::CameraReport report;
  report.source_name = source_->name();
  report.source = source_->statistics();
  report.reader = published_.load();
  report.time = base::steady_now();
  const std::lock_guard<std::mutex> lock(failure_mutex_);
  if (!failure_.empty()) {
    report.source.state = transport::SourceState::failed;
    report.source.error = failure_;
  }
  return report;
}

void SourceReader::run() {
  try {
    read();
  } catch (const std::exception& error) {
    const std::lock_guard<std::mutex> lock(failure_mutex_);
    failure_ = source_->name() + ": reading ended: " + error.what();
  }
}

void SourceReader::read() {
  transport::Reception reception;
  for (;;) {
    const std::chrono::nanoseconds wait(ready_.empty() ? -1 : 0);
    switch (source_->receive(reception, wait)) {
      case transport::Event::sample:
        dispatch(reception.sample);
        if (!reception.more) publish();
        break;
      case transport::Event::malformed:
        statistics_.has_fault = true;
        statistics_.last_fault = reception.fault;
        published_.store(statistics_);
        break;
      case transport::Event::idle:
        publish();
        break;
      case transport::Event::stopped:
      case transport::Event::ended:
      case transport::Event::failed:
        publish();
        return;
    }
  }
}

void SourceReader::dispatch(const transport::Sample& sample) {
  const std::int64_t now = base::steady_now();
  bool wanted = false;
  for (auto* camera : cameras_) {
    if (!camera->wants(sample.record)) continue;
    wanted = true;
    const auto update = camera->process(sample, now);
    if (update.is_empty()) continue;
    if (camera->is_ready()) publish();
    camera->make(update);
    ready_.push_back(camera);
  }
  if (!wanted) note_unknown(std::visit([](const auto& record) { return record.id; }, sample.record));
}

void SourceReader::publish() {
  auto& transforms = transforms_.renew().transforms;
  // Elements that stay keep the memory of their strings.
  transforms.resize(ready_.size());
  std::size_t count = 0;
  for (const auto* camera : ready_) {
    if (const auto* transform = camera->transform()) transforms[count++] = *transform;
  }
  transforms.resize(count);
  if (!transforms.empty()) tf_.publish(transforms_.current());
  for (auto* camera : ready_) camera->publish();
  for (auto* camera : ready_) camera->publish_camera_info();
  ready_.clear();
}

void SourceReader::note_unknown(std::uint32_t id) {
  ++statistics_.unknown_id_records;
  auto& ids = statistics_.unknown_ids;
  auto& count = statistics_.unknown_id_count;
  const auto end = ids.begin() + count;
  if (count < ids.size() && std::find(ids.begin(), end, id) == end) ids[count++] = id;
  published_.store(statistics_);
}

}  // namespace trk_bridge::nodes
