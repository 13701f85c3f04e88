#include "source_reader.h"

#include <algorithm>
#include <chrono>

#include "base/clock.h"

namespace trk_bridge::nodes {

SourceReader::SourceReader(std::unique_ptr<transport::Source> source, std::vector<CameraOutput*> cameras)
    : source_(std::move(source)), cameras_(std::move(cameras)) {}

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
    switch (source_->receive(reception, std::chrono::nanoseconds(-1))) {
      case transport::Event::sample:
        dispatch(reception.sample);
        break;
      case transport::Event::malformed:
        statistics_.has_fault = true;
        statistics_.last_fault = reception.fault;
        published_.store(statistics_);
        break;
      case transport::Event::idle:
        break;
      case transport::Event::stopped:
      case transport::Event::ended:
      case transport::Event::failed:
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
    camera->process(sample, now);
  }
  if (!wanted) note_unknown(std::visit([](const auto& record) { return record.id; }, sample.record));
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
