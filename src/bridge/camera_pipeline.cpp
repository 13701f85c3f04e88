// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_pipeline.h"

#include <chrono>
#include <cmath>
#include <variant>

#include "trk_bridge/wire/fields.h"

namespace trk_bridge::bridge {
namespace {

using camera::CameraReason;
using camera::ConstantsChange;

std::chrono::nanoseconds nanoseconds_of(double seconds) {
  return std::chrono::nanoseconds(std::llround(seconds * 1e9));
}

}  // namespace

CameraPipeline::CameraPipeline(const CameraOptions& options, std::optional<double> field_rate)
    : options_(options),
      lock_(nanoseconds_of(options.failover)),
      finds_rate_(!field_rate),
      sequence_(field_rate.value_or(assumed_field_rate), options.counter),
      stamper_(nanoseconds_of(options.delay)),
      converter_(options.format),
      calibrator_(options.plumb_bob_tolerance) {
  if (options.constants && converter_.use(*options.constants) != ConstantsChange::invalid) {
    statistics_.constants = ConstantsOrigin::parameter;
  }
}

bool CameraPipeline::wants(const wire::Record& record) const noexcept {
  if (!options_.id) return true;
  if (const auto* params = std::get_if<wire::CameraParams>(&record)) return params->id == *options_.id;
  const auto& constants = *std::get_if<wire::CameraConstants>(&record);
  return constants.id == *options_.id || constants.id == 0;
}

CameraUpdate CameraPipeline::initial() const noexcept {
  CameraUpdate update;
  if (converter_.outgoing() != nullptr) update.constants = *converter_.outgoing();
  return update;
}

void CameraPipeline::set(const LiveOptions& live) noexcept {
  static_cast<LiveOptions&>(options_) = live;
  stamper_.set_delay(nanoseconds_of(live.delay));
}

CameraUpdate CameraPipeline::process(const transport::Sample& sample, std::int64_t now) noexcept {
  auto update = begin(sample, now);
  calibrate(update);
  return update;
}

CameraUpdate CameraPipeline::begin(const transport::Sample& sample, std::int64_t now) noexcept {
  // std::visit is not used because the compiler assumes that it can throw.
  if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) return begin(*params, sample, now);
  return begin(*std::get_if<wire::CameraConstants>(&sample.record), sample, now);
}

CameraUpdate CameraPipeline::begin(const wire::CameraConstants& constants, const transport::Sample& sample,
                                   std::int64_t now) noexcept {
  if (lock_.claim(sample.sender, now) == SenderLock::Claim::foreign) {
    ignore(sample.sender);
    return {};
  }
  const bool own = !options_.id || constants.id == *options_.id;
  const auto origin = own ? ConstantsOrigin::own : ConstantsOrigin::any_camera;
  if (origin < statistics_.constants) return {};
  const ConstantsChange change = converter_.use(constants);
  if (change == ConstantsChange::invalid) {
    ++statistics_.bad_constants;
    return {};
  }
  statistics_.constants = origin;
  if (change == ConstantsChange::unchanged) return {};
  CameraUpdate update;
  update.stamp = stamper_.unordered(sample.arrival);
  update.constants = *converter_.outgoing();
  return update;
}

CameraUpdate CameraPipeline::begin(const wire::CameraParams& params, const transport::Sample& sample,
                                   std::int64_t now) noexcept {
  const SenderLock::Claim claim = lock_.claim(sample.sender, now);
  if (claim == SenderLock::Claim::foreign) {
    ignore(sample.sender);
    return {};
  }
  const camera::Converted converted = converter_.convert(params);
  const auto reason = camera::why_not_a_camera(converted, sample.has_lens);
  if (!reason) {
    if (claim == SenderLock::Claim::free) note_failover();
    lock_.take(sample.sender, now);
    statistics_.ignores_ports = lock_.ignores_ports();
  } else if (claim == SenderLock::Claim::free) {
    return drop(*reason);
  }
  if (!is_new(params, sample)) return {};
  const std::int64_t time = time_of(sample);
  statistics_.last_new = now;
  statistics_.sender = sample.sender;
  statistics_.encoding = sample.origin;
  statistics_.has_lens = sample.has_lens;
  if (!sample.has_lens) ++statistics_.without_lens;

  if (reason) return drop(*reason);
  const auto stamped = stamp(time);
  if (!stamped) return {};

  CameraUpdate update;
  update.stamp = *stamped;
  update.time_code = sample.time_code;
  if (sample.encoders != transport::LensEncoders{}) update.encoders = CameraEncoders{params.id, sample.encoders};
  if (options_.publish_tf) update.pose = *converted.pose;
  if (sample.has_lens) {
    add_lens(converted, update);
  } else {
    statistics_.has_camera_info = false;
  }
  return update;
}

void CameraPipeline::ignore(const transport::Sender& sender) noexcept {
  lock_.note_foreign(sender);
  ++statistics_.foreign;
  statistics_.foreign_sender = sender;
}

void CameraPipeline::note_failover() noexcept {
  if (!lock_.holder()) return;
  ++statistics_.failovers;
  statistics_.silent_sender = *lock_.holder();
  sequence_.forget_newest();
  clock_.forget();
}

bool CameraPipeline::is_new(const wire::CameraParams& params, const transport::Sample& sample) noexcept {
  if (statistics_.params > 0 && params.id != statistics_.last_id) ++statistics_.id_changes;
  ++statistics_.params;
  statistics_.last_id = params.id;
  statistics_.last_format = params.format;
  const bool accepted =
      !sample.has_counter || base::is_new(sequence_.classify(params.counter, wire::fingerprint(params)));
  if (!sample.has_counter) ++statistics_.without_counter;
  statistics_.sequence = sequence_.counts();
  statistics_.sequence.accepted += statistics_.without_counter;
  return accepted;
}

std::int64_t CameraPipeline::time_of(const transport::Sample& sample) noexcept {
  const std::int64_t by_rhythm = by_counter(sample);
  statistics_.rhythm = clock_.statistics();
  if (finds_rate_ && statistics_.rhythm.learned) sequence_.use_field_rate(1e9 / statistics_.rhythm.interval);
  if (sample.sample_time) statistics_.source_behind = sample.arrival - *sample.sample_time;
  switch (options_.stamp) {
    case StampMode::arrival:
      statistics_.stamp_state = StampState::arrival;
      break;
    case StampMode::counter:
      return by_rhythm;
    case StampMode::source:
      statistics_.stamp_state = sample.sample_time ? StampState::source : StampState::no_source_time;
      return sample.sample_time.value_or(sample.arrival);
  }
  return sample.arrival;
}

std::int64_t CameraPipeline::by_counter(const transport::Sample& sample) noexcept {
  const bool counts = statistics_.sequence.state == base::CounterState::counts;
  if (!sample.has_counter || !counts || !can_be_stamp(sample.arrival)) {
    statistics_.stamp_state = sample.has_counter ? StampState::uncounted : StampState::no_counter;
    if (!sample.has_counter || !counts) clock_.forget();
    return sample.arrival;
  }
  const std::int64_t time = clock_.stamp(sequence_.step(), sample.arrival);
  statistics_.stamp_state = clock_.statistics().learned ? StampState::counter : StampState::learning;
  return time;
}

std::optional<std::int64_t> CameraPipeline::stamp(std::int64_t time) noexcept {
  const auto stamp = stamper_.stamp(time);
  if (!stamp) {
    ++statistics_.dropped;
    ++statistics_.unstampable;
    return std::nullopt;
  }
  statistics_.held_stamps = stamper_.held();
  statistics_.stamp_ahead = stamper_.ahead();
  statistics_.clock_steps = stamper_.steps();
  statistics_.clock_step = stamper_.last_step();
  return stamp;
}

void CameraPipeline::add_lens(const camera::Converted& converted, CameraUpdate& update) noexcept {
  if (converted.params) {
    update.params = *converted.params;
  } else {
    ++statistics_.withheld;
    statistics_.withhold_reason = converted.params.error();
  }
  if (!options_.publish_camera_info) {
    statistics_.has_camera_info = false;
    return;
  }
  const auto* const constants = converter_.incoming();
  update.uncalibrated = {converted.lens, constants == nullptr ? std::nullopt : std::optional(*constants)};
}

void CameraPipeline::calibrate(CameraUpdate& update) noexcept {
  if (!update.uncalibrated) return;
  const auto calibration = calibration_of(*update.uncalibrated);
  update.uncalibrated.reset();
  statistics_.has_camera_info = calibration.has_value();
  if (!calibration) {
    ++statistics_.without_camera_info;
    statistics_.info_reason = calibration.error();
    return;
  }
  update.calibration = *calibration;
  statistics_.fit_residual = calibration->distortion.residual;
}

camera::Result<camera::Calibration> CameraPipeline::calibration_of(const Uncalibrated& given) noexcept {
  if (!given.constants) return tl::unexpected(CameraReason::constants_needed);
  if (!given.lens) return tl::unexpected(given.lens.error());
  return calibrator_.calibrate(*given.lens, *given.constants);
}

CameraUpdate CameraPipeline::drop(CameraReason reason) noexcept {
  ++statistics_.dropped;
  statistics_.drop_reason = reason;
  return {};
}

}  // namespace trk_bridge::bridge
