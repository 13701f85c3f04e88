// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "departures.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/clock.h"

namespace trk_bridge::bridge {
namespace {

bool is_timed(const OutputTiming& timing) noexcept { return timing.delay != transport::Delay{} || timing.lead != 0; }

/// ns; upper limit of one wait of the timer thread.
constexpr std::int64_t longest_wait = 1'000'000'000;

}  // namespace

Departures::Departures(DepartureOptions options, std::vector<Destination> destinations)
    : options_(std::move(options)), destinations_(std::move(destinations)) {
  for (std::size_t i = 0; i < destinations_.size(); ++i) {
    const auto& [timing, is_paced, write, lose] = destinations_[i];
    if (!is_paced && !is_timed(timing)) continue;
    paced_.push_back(i);
    timings_.push_back(timing);
  }
  if (paced_.empty()) return;
  // Parameters that pass unchanged, parameters that are due, and constants.
  ready_.reserve(3 * paced_.size() * OutletWriter::most_ids);
  thread_ = std::thread([this] { run(); });
}

Departures::~Departures() { finish(); }

void Departures::finish() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::int64_t delay = 0;
    for (const auto& [one, lead] : timings_) delay = std::max({delay, one.position, one.rotation, one.lens});
    double period = 0;
    for (const auto& [id, camera] : cameras_) period = std::max(period, camera.paced.rhythm().period());
    end_ = base::steady_now() + (delay > 0 ? delay + static_cast<std::int64_t>(period) : 0);
    wakes_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

Departures::Camera* Departures::camera_of(std::uint32_t id) {
  const std::uint32_t key = options_.feed == Feed::one_camera ? 0 : id;
  const auto known = cameras_.find(key);
  if (known != cameras_.end()) return &known->second;
  if (cameras_.size() < OutletWriter::most_ids)
    return &cameras_.try_emplace(key, options_.rate, timings_).first->second;
  for (const auto i : paced_) {
    if (destinations_[i].lose) destinations_[i].lose({id, OutletReason::too_many_ids});
  }
  return nullptr;
}

void Departures::write(const wire::CameraConstants& constants) {
  for (const auto& destination : destinations_) {
    if (!destination.is_paced && !is_timed(destination.timing)) destination.write(constants, 0);
  }
  if (paced_.empty()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto* camera = camera_of(constants.id);
    if (camera == nullptr || (camera->constants && *camera->constants == constants)) return;
    if (camera->constants) camera->paced.start_over();
    camera->constants = camera->new_constants = constants;
    wakes_ = true;
  }
  changed_.notify_one();
}

void Departures::write(const wire::CameraParams& params, const transport::RecordTime& time, std::int64_t lens_time) {
  for (const auto& destination : destinations_) {
    if (!destination.is_paced && !is_timed(destination.timing)) destination.write(params, time);
  }
  if (paced_.empty()) return;
  const auto clock = options_.clock();
  const auto now = base::steady_now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto* camera = camera_of(params.id);
    if (camera == nullptr) return;
    const bool was_due = camera->paced.due().has_value();
    const bool is_valid = camera->paced.add(params, time.nanoseconds, lens_time, now, clock).has_value();
    if (!is_valid) camera->unchanged.emplace(params, time.nanoseconds);
    if (was_due && is_valid && !camera->paced.waits(now)) return;
    wakes_ = true;
  }
  changed_.notify_one();
}

void Departures::write(const OutgoingSet& set) {
  if (set.constants) write(*set.constants);
  write(set.params, set.time, set.lens_time);
}

std::optional<std::int64_t> Departures::next_due() const {
  std::optional<std::int64_t> next;
  for (const auto& [id, camera] : cameras_) {
    if (const auto due = camera.paced.due(); due && (!next || *due < *next)) next = due;
  }
  return next;
}

void Departures::run() {
  using Time = std::chrono::steady_clock::time_point;
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    const auto now = base::steady_now();
    collect(now);
    if (!ready_.empty()) {
      lock.unlock();
      for (const auto& [output, record, time] : ready_) destinations_[paced_[output]].write(record, time);
      ready_.clear();
      lock.lock();
      continue;
    }
    if (end_ && now >= *end_) return;
    const std::int64_t until = std::min(next_due().value_or(now + longest_wait), end_.value_or(now + longest_wait));
    changed_.wait_until(lock, Time(std::chrono::nanoseconds(until)), [this] { return wakes_; });
    wakes_ = false;
  }
}

void Departures::collect(std::int64_t now) {
  for (auto& [id, camera] : cameras_) collect(camera, now);
}

void Departures::collect(Camera& camera, std::int64_t now) {
  const auto clock = options_.clock();
  if (camera.paced.due() && *camera.paced.due() <= now) camera.paced.depart(now, clock);
  for (std::size_t output = 0; output < paced_.size(); ++output) {
    if (camera.new_constants) ready_.push_back({output, *camera.new_constants, 0});
    if (camera.unchanged) ready_.push_back({output, camera.unchanged->first, camera.unchanged->second});
    if (const auto departure = camera.paced.take(output, now, clock)) {
      ready_.push_back({output, departure->params, departure->time});
    }
  }
  camera.new_constants.reset();
  camera.unchanged.reset();
}

bool Departures::set_timing(std::size_t destination, const OutputTiming& timing) {
  const auto found = std::find(paced_.begin(), paced_.end(), destination);
  if (found == paced_.end()) return false;
  const auto output = static_cast<std::size_t>(found - paced_.begin());
  const std::lock_guard<std::mutex> lock(mutex_);
  timings_[output] = timing;
  for (auto& [id, camera] : cameras_) camera.paced.set_timing(output, timing);
  return true;
}

std::optional<DepartureStatistics> Departures::statistics(std::size_t destination) const {
  const auto found = std::find(paced_.begin(), paced_.end(), destination);
  if (found == paced_.end()) return std::nullopt;
  const auto output = static_cast<std::size_t>(found - paced_.begin());
  const std::lock_guard<std::mutex> lock(mutex_);
  DepartureStatistics all;
  for (const auto& [id, camera] : cameras_) {
    const auto& one = camera.paced.statistics(output);
    all.sent += one.sent;
    all.departures += one.departures;
    all.negative += one.negative;
    all.ignored += one.ignored;
    all.age_sum += one.age_sum;
    all.margin_sum += one.margin_sum;
    if (one.last_sent < all.last_sent) continue;
    all.last_sent = one.last_sent;
    all.last_time = one.last_time;
  }
  return all;
}

}  // namespace trk_bridge::bridge
