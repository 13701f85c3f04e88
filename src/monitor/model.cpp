#include "model.h"

#include <algorithm>
#include <variant>

#include "trk_bridge/camera/image.h"

namespace trk_bridge::monitor {
namespace {

constexpr double silent_after = 1.0;            // s
constexpr double silent_after_intervals = 3.0;  // for what comes more slowly than three times a second

double seconds_between(Model::Time from, Model::Time to) { return std::chrono::duration<double>(to - from).count(); }

camera::Result<double> horizontal_angle(const camera::Lens& lens, const wire::CameraConstants* constants) {
  if (constants == nullptr) return tl::unexpected(camera::CameraReason::constants_needed);
  if (const auto sound = camera::check(*constants); !sound) return tl::unexpected(sound.error());
  return camera::field_of_view(lens.image_distance, constants->chip_width);
}

}  // namespace

void Model::add(const transport::Sample& sample, Time now) {
  const auto order = tally_.add(sample);
  const cli::Tally::Key key{std::visit([](const auto& record) { return record.id; }, sample.record), sample.sender};
  auto track = tracks_.find(key);
  if (track == tracks_.end()) {
    if (tracks_.size() == cli::Tally::most_cameras) {
      ++not_shown_;
      return;
    }
    track = tracks_.try_emplace(key).first;
  }
  if (const auto* constants = std::get_if<wire::CameraConstants>(&sample.record)) {
    track->second.constants = *constants;
  } else if (order && base::is_new(*order)) {
    add_params(track->second, sample, std::get<wire::CameraParams>(sample.record), now);
  }
}

void Model::add_params(Track& track, const transport::Sample& sample, const wire::CameraParams& params, Time now) {
  track.latest = Latest{params, sample.has_lens, sample.encoders, sample.doubt, sample.origin, sample.time_code, now};
  track.arrivals.add(sample.arrival);
  if (const auto pose = camera::decode_pose(params)) {
    const auto angles = camera::pan_tilt_roll(pose->linear());
    const auto& at = pose->translation();
    track.poses.add(sample.arrival, {at.x(), at.y(), at.z(), angles.pan, angles.tilt, angles.roll});
  }
}

void Model::add_malformed(const transport::Reception& reception, Time now) {
  malformed_ = Malformed{reception.fault, reception.sample.sender, now};
}

State Model::state(Time now, const transport::Source& source) const {
  State state;
  state.source_name = source.name();
  state.source = source.statistics();
  state.not_shown = not_shown_;
  if (malformed_) {
    state.malformed = MalformedState{malformed_->fault, malformed_->sender, seconds_between(malformed_->came, now)};
  }
  for (const auto& [key, track] : tracks_) state.cameras.push_back(state_of(key, track, now));
  std::stable_partition(state.cameras.begin(), state.cameras.end(),
                        [](const CameraState& camera) { return camera.latest && !camera.latest->is_silent; });
  return state;
}

CameraState Model::state_of(const cli::Tally::Key& key, const Track& track, Time now) const {
  CameraState state;
  state.key = key;
  state.constants = track.constants;
  if (!track.latest) return state;
  state.counts = tally_.cameras().at(key).counts();
  state.rate = track.arrivals.rate();
  state.jitter = track.arrivals.jitter();
  state.rest = track.poses.judge();

  const auto* constants = track.constants ? &*track.constants : nullptr;
  const auto& params = track.latest->params;
  const auto lens = track.latest->has_lens ? camera::decode_lens(params, constants)
                                           : tl::make_unexpected(camera::CameraReason::no_lens);
  const auto angle = lens.and_then([&](const camera::Lens& known) { return horizontal_angle(known, constants); });
  const double age = seconds_between(track.latest->came, now);
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
