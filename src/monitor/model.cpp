// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "trk_bridge/camera/image.h"
#include "trk_bridge/wire/fields.h"

namespace trk_bridge::monitor {
namespace {

constexpr double silent_after = 1.0;                     // s
constexpr double silent_after_intervals = 3.0;           // for rates below 3 Hz
constexpr std::int64_t between_snapshots = 500'000'000;  // ns

double seconds_between(Model::Time from, Model::Time to) { return std::chrono::duration<double>(to - from).count(); }

std::int64_t nanoseconds_of(Model::Time time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

std::uint32_t id_of(const transport::Sample& sample) {
  return std::visit([](const auto& record) { return record.id; }, sample.record);
}

camera::Result<double> horizontal_angle(const camera::Lens& lens, const wire::CameraConstants* constants) {
  if (constants == nullptr) return tl::unexpected(camera::CameraReason::constants_needed);
  if (const auto checked = camera::check(*constants); !checked) return tl::unexpected(checked.error());
  return camera::field_of_view(lens.image_distance, constants->chip_width);
}

/// Counts since `before`.
transport::SourceStatistics since(transport::SourceStatistics now, const transport::SourceStatistics& before) {
  now.records -= before.records;
  now.malformed -= before.malformed;
  now.refused -= before.refused;
  now.kernel_drops -= before.kernel_drops;
  now.overwritten -= before.overwritten;
  now.unknown_format_bits -= before.unknown_format_bits;
  now.doubtful -= before.doubtful;
  return now;
}

/// Loss between two counts, in percent.
std::optional<double> loss_between(const base::SequenceCounts& before, const base::SequenceCounts& now) {
  const auto accepted = now.accepted - before.accepted;
  // A late record reduces the number of lost ones.
  const auto lost = now.lost > before.lost ? now.lost - before.lost : 0;
  if (accepted + lost == 0) return {};
  return 100.0 * static_cast<double>(lost) / static_cast<double>(accepted + lost);
}

}  // namespace

State frozen(State state) {
  for (auto& camera : state.cameras) {
    if (camera.history) camera.history = std::make_shared<History>(*camera.history);
  }
  return state;
}

Model::Model(Time begin, transport::SourceStatistics before) : begin_(begin), before_(std::move(before)) {
  snapshots_.push_back({nanoseconds_of(begin), before_, read_kernel_counters(), {}});
}

const wire::CameraConstants* Model::Track::constants_or_null() const {
  return constants ? std::get_if<wire::CameraConstants>(&constants->record) : nullptr;
}

void Model::add(const transport::Sample& sample, Time now) {
  const cli::Tally::Key key{id_of(sample), sample.sender};
  auto track = tracks_.find(key);
  if (track == tracks_.end()) {
    if (tracks_.size() == cli::Tally::most_cameras) {
      ++not_shown_;
      return;
    }
    track = tracks_.try_emplace(key).first;
    const auto use = sample.has_counter ? base::CounterUse::automatic : base::CounterUse::ignore;
    track->second.sequence = base::Sequence(bridge::assumed_field_rate, use);
  }
  watch(sample, now);
  if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) {
    add_params(track->second, sample, *params, now);
  } else {
    track->second.constants = sample;
  }
}

void Model::watch(const transport::Sample& sample, Time now) {
  const std::int64_t time = nanoseconds_of(now);
  if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) {
    auto& camera = watched(params->id, now);
    (void)camera.pipeline.begin(sample, time);
    if (sample.has_counter && camera.pipeline.statistics().sender == sample.sender) camera.counter.add(params->counter);
    return;
  }
  for (auto& [id, camera] : watched_) {
    if (camera.pipeline.wants(sample.record)) (void)camera.pipeline.begin(sample, time);
  }
}

/// A new one gets the constants that were received before.
Model::Watched& Model::watched(std::uint32_t id, Time now) {
  const auto known = watched_.find(id);
  if (known != watched_.end()) return known->second;
  auto& camera = watched_.try_emplace(id, Watched{bridge::CameraPipeline(watch_options(id), {}), {}}).first->second;
  for (const auto& [key, track] : tracks_) {
    if (track.constants && camera.pipeline.wants(track.constants->record)) {
      (void)camera.pipeline.begin(*track.constants, nanoseconds_of(now));
    }
  }
  return camera;
}

void Model::add_params(Track& track, const transport::Sample& sample, const wire::CameraParams& params, Time now) {
  if (!base::is_new(track.sequence.classify(params.counter, wire::fingerprint(params)))) return;
  track.latest = Latest{params, sample.has_lens, sample.encoders, sample.doubt, sample.origin, sample.time_code, now};

  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Values values;
  values.fill(unknown);
  const auto set = [&values](Value value, double number) { values[static_cast<std::size_t>(value)] = number; };
  if (track.history.newest() != 0) {
    set(Value::interval, static_cast<double>(sample.arrival - track.history.newest()) * 1e-6);
  }
  track.arrivals.add(sample.arrival, track.sequence.step());
  if (const auto pose = camera::decode_pose(params)) {
    const auto angles = camera::pan_tilt_roll(pose->linear());
    const auto& at = pose->translation();
    const PoseNumbers numbers{at.x(), at.y(), at.z(), angles.pan, angles.tilt, angles.roll};
    track.poses.add(sample.arrival, numbers);
    std::copy(numbers.begin(), numbers.end(), values.begin());
  }
  if (sample.has_lens) {
    if (const auto lens = camera::decode_lens(params, track.constants_or_null())) {
      set(Value::lens, lens->image_distance);
    }
    set(Value::focus, params.focdist);
    set(Value::iris, params.aperture);
  }
  track.history.add(sample.arrival, values);
}

void Model::add_malformed(const transport::Reception& reception, Time now) {
  malformed_ = Malformed{reception.fault, reception.sample.sender, now};
}

bridge::CameraReport Model::report(const Snapshot& snapshot, std::optional<std::uint32_t> id,
                                   const std::string& source_name) const {
  bridge::CameraReport report;
  report.source_name = source_name;
  report.source = snapshot.source;
  report.reader.has_fault = malformed_.has_value();
  if (malformed_) report.reader.last_fault = malformed_->fault;
  const auto camera = id ? snapshot.cameras.find(*id) : snapshot.cameras.end();
  if (camera != snapshot.cameras.end()) report.camera = camera->second;
  report.time = snapshot.time;
  return report;
}

SourceReports Model::compare(Time now, const transport::Source& source) {
  Snapshot latest{nanoseconds_of(now), source.statistics(), read_kernel_counters(), {}};
  for (const auto& [id, camera] : watched_) latest.cameras.emplace(id, camera.pipeline.statistics());
  while (snapshots_.size() > 1 && static_cast<double>(latest.time - snapshots_[1].time) >= findings_span * 1e9) {
    snapshots_.pop_front();
  }
  const Snapshot& earlier = snapshots_.front();
  const std::string name = source.name();
  SourceReports reports{
      report(latest, {}, name),
      report(earlier, {}, name),
      {latest.kernel.unclaimed - earlier.kernel.unclaimed, latest.kernel.reverse_path - earlier.kernel.reverse_path},
      {}};
  for (const auto& [id, camera] : watched_) {
    CameraReports of_camera;
    of_camera.id = id;
    of_camera.now = report(latest, id, name);
    of_camera.before = report(earlier, id, name);
    const auto track = tracks_.find({id, camera.pipeline.statistics().sender});
    if (track != tracks_.end()) of_camera.unevenness = track->second.arrivals.unevenness();
    of_camera.time_code = camera.counter.description().value_or("");
    reports.cameras.push_back(std::move(of_camera));
  }
  if (latest.time - snapshots_.back().time >= between_snapshots) snapshots_.push_back(std::move(latest));
  return reports;
}

State Model::state(Time now, const transport::Source& source) {
  const SourceReports reports = compare(now, source);
  State state;
  state.source_name = reports.now.source_name;
  state.age = seconds_between(begin_, now);
  state.findings = findings_of(reports);
  state.source = since(reports.now.source, before_);
  state.not_shown = not_shown_;
  state.recent_malformed = reports.now.source.malformed - reports.before.source.malformed;
  state.recent_drops = reports.now.source.kernel_drops - reports.before.source.kernel_drops;
  if (malformed_) {
    state.malformed = MalformedState{malformed_->fault, malformed_->sender, seconds_between(malformed_->arrived, now)};
  }
  for (const auto& [key, track] : tracks_) {
    state.cameras.push_back(state_of(key, track, now));
    for (const auto& camera : reports.cameras) {
      if (camera.id != key.id) continue;
      state.cameras.back().loss = loss_between(camera.before.camera.sequence, camera.now.camera.sequence);
    }
  }
  std::stable_partition(state.cameras.begin(), state.cameras.end(),
                        [](const CameraState& camera) { return camera.latest && !camera.latest->is_silent; });
  return state;
}

CameraState Model::state_of(const cli::Tally::Key& key, const Track& track, Time now) {
  CameraState state;
  state.key = key;
  const auto* constants = track.constants_or_null();
  if (constants != nullptr) state.constants = *constants;
  if (!track.latest) return state;
  state.counts = track.sequence.counts();
  state.rate = track.arrivals.rate();
  state.jitter = track.arrivals.jitter();
  state.intervals = track.arrivals.intervals();
  state.rest = track.poses.classify();
  // Does not own the history of the model.
  state.history = std::shared_ptr<const History>(std::shared_ptr<const History>(), &track.history);

  const auto& params = track.latest->params;
  const auto lens = track.latest->has_lens ? camera::decode_lens(params, constants)
                                           : tl::make_unexpected(camera::CameraReason::no_lens);
  const auto angle = lens.and_then([&](const camera::Lens& known) { return horizontal_angle(known, constants); });
  const double age = seconds_between(track.latest->arrived, now);
  const double interval = state.jitter ? static_cast<double>(state.jitter->interval) * 1e-9 : 0;
  state.latest = ParamsState{params,
                             track.latest->origin,
                             camera::decode_pose(params),
                             lens,
                             angle,
                             age,
                             age > std::max(silent_after, silent_after_intervals * interval),
                             track.latest->time_code,
                             track.latest->encoders,
                             track.latest->doubt};
  return state;
}

}  // namespace trk_bridge::monitor
