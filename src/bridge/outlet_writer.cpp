// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "outlet_writer.h"

#include <utility>

#include "base/clock.h"

namespace trk_bridge::bridge {

using camera::CameraReason;

std::string describe(OutletReason reason) {
  switch (reason) {
    case OutletReason::too_many_ids:
      return "constants of more than " + std::to_string(OutletWriter::most_ids) +
             " ids were received; more are not accepted";
    case OutletReason::outdated:
      return "the oldest parameters were dropped, because the sink does not keep up";
    case OutletReason::too_slow:
      return "the recording has ended, because the sink could not keep up; it holds everything before";
  }
  return "unknown reason";
}

OutletWriter::OutletWriter(std::unique_ptr<transport::Sink> sink, const transport::SinkForm& form, Feed feed,
                           LossListener listener)
    : sink_(std::move(sink)),
      form_(form),
      feed_(feed),
      listener_(std::move(listener)),
      without_constants_(form.format) {}

OutletWriter::Camera* OutletWriter::find(std::uint32_t id) noexcept {
  const auto found = cameras_.find(key(id));
  return found == cameras_.end() ? nullptr : &found->second;
}

OutletWriter::Camera* OutletWriter::find_or_add(std::uint32_t id) {
  if (auto* known = find(id)) return known;
  if (cameras_.size() == most_ids) return nullptr;
  return &cameras_.emplace(key(id), Camera{without_constants_, {}}).first->second;
}

void OutletWriter::write(const wire::CameraConstants& constants) {
  if (const auto checked = camera::check(constants); !checked) {
    write_invalid(constants, checked.error());
  } else if (auto* camera = find_or_add(constants.id); camera == nullptr) {
    refuse(constants, OutletReason::too_many_ids);
  } else if (camera->converter.use(constants) == camera::ConstantsChange::changed) {
    camera->constants_written = put(*camera->converter.outgoing());
    camera->retries = false;
  }
  publish();
}

void OutletWriter::write_invalid(const wire::CameraConstants& constants, CameraReason reason) {
  if (auto* camera = find(constants.id)) *camera = Camera{without_constants_, {}};
  if (form_.format) return refuse(constants, reason);
  // No conversion was requested: the receiver decides what to do with them. put() reports a fault.
  static_cast<void>(put(constants));
}

void OutletWriter::refuse(const wire::CameraConstants& constants, const Loss::Cause& cause) {
  ++statistics_.refused_constants;
  lose(constants.id, cause);
}

void OutletWriter::write(const wire::CameraParams& params, const transport::RecordTime& time) {
  auto* camera = find(params.id);
  if (const auto outgoing = converted(params, camera)) {
    const auto constants_written = constants_before_set(camera);
    const auto params_written = put(*outgoing, time);
    const auto now = base::steady_now();
    statistics_.fails = !constants_written || !params_written;
    if (statistics_.fails) {
      ++statistics_.failed_sets;
      // A file without constants accepts no parameters: the fault of the constants is the cause.
      statistics_.last_fault = constants_written ? params_written.error() : constants_written.error();
      statistics_.last_failure = now;
    }
    if (params_written) statistics_.last_success = now;
  }
  publish();
}

std::optional<wire::CameraParams> OutletWriter::converted(const wire::CameraParams& params, const Camera* camera) {
  if (!form_.format && feed_ == Feed::passed_on) return params;
  const auto converted = (camera != nullptr ? camera->converter : without_constants_).convert(params);
  if (const auto reason = camera::why_not_a_camera(converted); reason && feed_ == Feed::one_camera) {
    ++statistics_.dropped;
    statistics_.drop_reason = *reason;
    lose(params.id, *reason);
    return std::nullopt;
  }
  if (!converted.params) {
    ++statistics_.withheld;
    statistics_.withhold_reason = converted.params.error();
    lose(params.id, converted.params.error());
    return std::nullopt;
  }
  return *converted.params;
}

transport::WriteResult OutletWriter::constants_before_set(Camera* camera) {
  if (camera == nullptr) return {};
  if (camera->retries) camera->constants_written = put(*camera->converter.outgoing());
  // If the first attempt was made just before this set, it is not repeated at once.
  camera->retries = !camera->constants_written;
  return camera->constants_written;
}

template <typename Record, typename... Time>
transport::WriteResult OutletWriter::put(Record record, const Time&... time) {
  const auto own_id = record.id;
  record.id = sent_id(form_, own_id);
  statistics_.last_id = record.id;
  if (const auto wanted = form_.id.value_or(own_id); wanted != record.id) statistics_.unsent_id = wanted;
  const auto written = sink_->write(record, time...);
  if (!written) lose(own_id, written.error());
  return written;
}

transport::WriteResult OutletWriter::close() {
  const auto closed = sink_->close();
  publish();
  return closed;
}

void OutletWriter::lose(std::uint32_t id, const Loss::Cause& cause) const {
  if (listener_) listener_({id, cause});
}

void OutletWriter::publish() noexcept {
  statistics_.sent = sink_->statistics();
  published_.store(statistics_);
}

}  // namespace trk_bridge::bridge
