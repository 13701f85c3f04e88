// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.h"

#include <cmath>
#include <cstdio>

#include "base/number_text.h"
#include "diagnostic_text.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge {
namespace {

using transport::SourceState;

/// s that TAI is ahead of UTC, since 2017.
constexpr long long tai_ahead = 37;

double rate_of(const CameraReport& now, const CameraReport& before) {
  return rate_between(before.camera.sequence.accepted, now.camera.sequence.accepted, before.time, now.time);
}

std::string ids_text(const ReaderStatistics& reader) {
  std::string text;
  for (std::uint32_t i = 0; i < reader.unknown_id_count; ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(reader.unknown_ids[i]);
  }
  return text;
}

std::string fault_text(const ReaderStatistics& reader) {
  return reader.has_fault ? describe(reader.last_fault) : std::string("none");
}

const char* counter_text(base::CounterState state) {
  switch (state) {
    case base::CounterState::counts:
      return "counts";
    case base::CounterState::cycles:
      return "restarts every few records";
    case base::CounterState::frozen:
      return "stands still";
    case base::CounterState::ignored:
      return "ignored";
  }
  return "";
}

std::string stamp_text(const CameraStatistics& camera) {
  switch (camera.stamp_state) {
    case StampState::arrival:
      return "arrival";
    case StampState::learning:
      return "arrival: the counter's rhythm is not learned";
    case StampState::no_counter:
      return "arrival: the records have no counter";
    case StampState::uncounted:
      return std::string("arrival: the counter ") + counter_text(camera.sequence.state);
    case StampState::counter:
      return "counter";
    case StampState::no_source_time:
      return "arrival: the records have no time of the sender";
    case StampState::source:
      return "source";
  }
  return "";
}

std::string milliseconds_text(double nanoseconds) { return base::fixed_text(nanoseconds / 1e6, 3); }

/// "37.0 s ahead of", "2.1 s behind".
std::string offset_text(std::int64_t behind) {
  return duration_text(std::abs(seconds_between(0, behind))) + (behind < 0 ? " ahead of" : " behind");
}

/// "8388608 bytes", "212992 of 8388608 bytes: net.core.rmem_max allows no more".
std::string receive_buffer_text(const transport::SourceStatistics& source) {
  if (source.receive_buffer == 0) return "none";
  const std::string granted = std::to_string(source.receive_buffer);
  if (source.receive_buffer >= source.wanted_buffer) return granted + " bytes";
  return granted + " of " + std::to_string(source.wanted_buffer) + " bytes: net.core.rmem_max allows no more";
}

std::string camera_info_text(const CameraStatistics& camera) {
  if (camera.has_camera_info) return "yes";
  if (!camera.has_lens) return "no: the records have no lens";
  if (camera.without_camera_info > 0) return "no: " + camera::describe(camera.info_reason);
  return "no";
}

/// The state before the first parameters of this camera.
Finding silence(const CameraReport& now, const CameraOptions& options) {
  switch (now.source.state) {
    case SourceState::waiting:
      return {Condition::waiting, Level::stale, now.source.waiting_for};
    case SourceState::nothing_valid:
      return {Condition::nothing_valid, Level::warn, "datagrams arrive, but none is trk: " + fault_text(now.reader)};
    case SourceState::only_refused:
      return {Condition::only_refused, Level::warn,
              "datagrams arrive, but only from senders that are not allowed, last " +
                  transport::to_string(now.source.last_refused)};
    default:
      break;
  }
  if (options.id && now.reader.unknown_id_records > 0) {
    return {Condition::other_ids_only, Level::warn,
            "parameters arrive, but none with id " + std::to_string(*options.id) + "; seen: " + ids_text(now.reader)};
  }
  return {Condition::constants_only, Level::warn, "records arrive, but no parameters of this camera yet"};
}

Finding state(const CameraReport& now, const CameraReport& before, const CameraOptions& options, double field_rate) {
  if (now.source.state == SourceState::failed) {
    return {Condition::failed, Level::error, "the source failed: " + now.source.error};
  }
  if (now.source.state == SourceState::ended) return {Condition::ended, Level::ok, "ended"};
  if (now.camera.sequence.accepted == 0) return silence(now, options);
  const double age = seconds_between(now.camera.last_new, now.time);
  if (age > silence_after(field_rate)) {
    if (now.camera.sequence.duplicates > before.camera.sequence.duplicates) {
      return {Condition::counter_frozen, Level::warn,
              "nothing new for " + duration_text(age) + ": records arrive, but their counter stands still"};
    }
    const std::string why = now.source.waiting_for.empty() ? "" : "; waiting for " + now.source.waiting_for;
    return {Condition::nothing_new, Level::warn, "nothing new for " + duration_text(age) + why};
  }
  return {Condition::receiving, Level::ok,
          "receiving from " + transport::to_string(now.camera.sender) + " at " + two_decimals(rate_of(now, before)) +
              " Hz"};
}

void add_source_findings(std::vector<Finding>& found, const CameraReport& now, const CameraReport& before) {
  const bool nothing_valid = now.source.state == SourceState::nothing_valid;
  if (now.source.malformed > before.source.malformed && !nothing_valid) {
    warn(found, Condition::malformed, "malformed records: " + fault_text(now.reader));
  }
  if (now.source.doubtful > before.source.doubtful) {
    warn(found, Condition::doubtful, std::string("records are accepted despite: ") + now.source.last_doubt);
  }
  if (now.source.refused > before.source.refused && now.source.state != SourceState::only_refused) {
    warn(found, Condition::refused,
         "datagrams from senders that are not allowed, last " + transport::to_string(now.source.last_refused));
  }
  if (now.source.kernel_drops > before.source.kernel_drops) {
    warn(found, Condition::kernel_drops,
         "the kernel dropped datagrams: the receive buffer was full (" + receive_buffer_text(now.source) + ")");
  }
  if (now.reader.unknown_id_records > before.reader.unknown_id_records) {
    warn(found, Condition::unknown_ids, "records with ids that no camera has: " + ids_text(now.reader));
  }
}

void add_sender_findings(std::vector<Finding>& found, const CameraReport& now, const CameraReport& before,
                         const CameraOptions& options) {
  const auto& camera = now.camera;
  if (camera.failovers > before.camera.failovers) {
    found.push_back({Condition::failover, Level::warn,
                     transport::to_string(camera.silent_sender) + " was silent for " + duration_text(options.failover) +
                         " or more: " + transport::to_string(camera.sender) + " is followed now",
                     /*is_event=*/true});
  }
  if (camera.foreign > before.camera.foreign) {
    warn(found, Condition::foreign_sender,
         "records of a second sender, " + transport::to_string(camera.foreign_sender) +
             ", are ignored: this camera follows " + transport::to_string(camera.sender));
  }
  if (camera.ignores_ports) {
    warn(found, Condition::ports_change,
         "the sender changes its port with every datagram: senders are distinguished by their address only");
  }
  const auto counter = camera.sequence.state;
  if (counter == base::CounterState::cycles || counter == base::CounterState::frozen) {
    warn(found, Condition::uncounted,
         std::string("the counter ") + counter_text(counter) + ": records are published in order of arrival");
  }
}

void add_camera_findings(std::vector<Finding>& found, const CameraReport& now, const CameraReport& before,
                         const CameraOptions& options) {
  const auto& camera = now.camera;
  const auto& old = before.camera;
  if (camera.sequence.lost > old.sequence.lost) {
    warn(found, Condition::lost, "lost " + std::to_string(camera.sequence.lost - old.sequence.lost));
  }
  if (camera.id_changes > old.id_changes) {
    warn(found, Condition::several_ids, "the id changes: set the id that this camera should follow");
  }
  if (camera.unstampable > old.unstampable) {
    warn(found, Condition::unstampable, "records dropped: their time is outside of 1970 to 2106");
  }
  if (camera.dropped - camera.unstampable > old.dropped - old.unstampable) {
    warn(found, Condition::dropped, "records dropped: " + camera::describe(camera.drop_reason));
  }
  if (camera.bad_constants > old.bad_constants) {
    warn(found, Condition::bad_constants,
         "constants ignored: " + camera::describe(camera::CameraReason::bad_constants));
  }
  const bool no_constants = camera.constants == ConstantsOrigin::none;
  if (camera.withheld > old.withheld && camera.withhold_reason == camera::CameraReason::constants_needed) {
    warn(found, Condition::withheld,
         "no constants yet: format '" + wire::format_to_words(camera.last_format) + "' needs them");
  } else if (camera.withheld > old.withheld) {
    warn(found, Condition::withheld, "params withheld: " + camera::describe(camera.withhold_reason));
  } else if (!camera.has_lens) {
    found.push_back({Condition::pose_only, Level::ok,
                     "the records have no lens: only tf and, if present, lens_encoders are published"});
  } else if (no_constants && options.publish_camera_info && camera.sequence.accepted > 0) {
    warn(found, Condition::no_constants, "no constants yet: no camera_info");
  }
  if (!no_constants && camera.without_camera_info > old.without_camera_info) {
    warn(found, Condition::no_camera_info, "no camera_info: " + camera::describe(camera.info_reason));
  }
  if (camera.has_camera_info && camera.fit_residual > visible_pixels) {
    warn(found, Condition::lens_inexact,
         "camera_info describes the distortion with an error of up to " + pixels_text(camera.fit_residual) + " px");
  }
  if (now.markers.not_drawn > before.markers.not_drawn) {
    warn(found, Condition::no_markers, "no markers: " + describe(now.markers.reason));
  }
  if (camera.held_stamps > old.held_stamps) {
    warn(found, Condition::stamps_held,
         "the clock stopped or stepped back: stamps are " + duration_text(seconds_between(0, camera.stamp_ahead)) +
             " ahead");
  }
  if (camera.clock_steps > old.clock_steps) {
    warn(found, Condition::clock_stepped,
         "the clock went back by " + duration_text(seconds_between(0, camera.clock_step)) + ": stamps follow it");
  }
}

void add_stamp_findings(std::vector<Finding>& found, const CameraReport& now, const CameraReport& before,
                        const CameraOptions& options) {
  const auto& camera = now.camera;
  const auto& rhythm = camera.rhythm;
  const auto& old = before.camera.rhythm;
  if (camera.stamp_state == StampState::no_source_time) {
    warn(found, Condition::stamps_are_arrivals,
         "stamp: source, but the records have no time of the sender: stamps are arrivals");
  }
  if (camera.stamp_state == StampState::no_counter) {
    found.push_back({Condition::stamps_are_arrivals, Level::ok, "the records have no counter: stamps are arrivals"});
  }
  if (camera.source_behind && std::abs(seconds_between(0, *camera.source_behind)) >= 1) {
    const bool is_tai = std::abs(std::llround(seconds_between(0, *camera.source_behind))) == tai_ahead;
    warn(found, Condition::source_clock_off,
         "the sender's time is " + offset_text(*camera.source_behind) + " this machine's clock" +
             (is_tai ? ": one is TAI (PTP), the other UTC; nothing is corrected" : ""));
  }
  if (options.stamp != StampMode::counter) return;
  if (rhythm.steps > old.steps) {
    warn(found, Condition::path_stepped,
         "the delay of the path became " + milliseconds_text(std::abs(rhythm.last_step)) + " ms " +
             (rhythm.last_step > 0 ? "longer" : "shorter") + ": stamps follow it");
  }
  if (rhythm.restarts > old.restarts) {
    warn(found, Condition::counter_restarted, "the counter restarted or jumped: stamps keep its rate");
  }
  if (rhythm.rate_changes > old.rate_changes) {
    warn(found, Condition::rate_changed, "the counter's rate changed: stamps are arrivals until it is learned");
  }
}

void add_stamp_values(Status& status, const CameraStatistics& camera) {
  const auto& rhythm = camera.rhythm;
  const double rate = rhythm.interval > 0 ? 1e9 / rhythm.interval : 0;
  const StandardRate* standard = standard_rate(rate);
  const bool by_counter = camera.stamp_state == StampState::counter;
  status.add("stamps", camera.sequence.accepted > 0 ? stamp_text(camera) : std::string("none yet"));
  status.add("counter rate (Hz)", rate > 0 ? base::fixed_text(rate, 6) : std::string("none yet"));
  status.add("standard rate (Hz)", standard != nullptr ? standard->name : "none");
  status.add("off standard rate (ppm)",
             standard != nullptr ? two_decimals((rate / standard->rate - 1) * 1e6) : std::string("none"));
  status.add("jitter of arrivals (ms)", milliseconds_text(rhythm.jitter_before));
  status.add("jitter of stamps (ms)", milliseconds_text(by_counter ? rhythm.jitter_after : rhythm.jitter_before));
  status.add("arrivals left out", rhythm.outliers);
  status.add("delay steps", rhythm.steps);
  status.add("counter restarts", rhythm.restarts);
  status.add("rate changes", rhythm.rate_changes);
  status.add("sender's time behind (s)", camera.source_behind
                                             ? base::fixed_text(seconds_between(0, *camera.source_behind), 6)
                                             : std::string("none"));
}

}  // namespace

std::vector<Finding> findings(const CameraReport& now, const CameraReport& before, const CameraOptions& options,
                              double field_rate) {
  std::vector<Finding> found{state(now, before, options, field_rate)};
  add_source_findings(found, now, before);
  add_sender_findings(found, now, before, options);
  add_camera_findings(found, now, before, options);
  add_stamp_findings(found, now, before, options);
  return found;
}

void fill(Status& status, const std::vector<Finding>& found, const CameraReport& now, const CameraReport& before) {
  status.hardware_id = now.source_name;
  summarize(found, status);

  const auto& camera = now.camera;
  const bool any = camera.sequence.accepted > 0;
  status.add("source", now.source_name);
  status.add("rate (Hz)", two_decimals(rate_of(now, before)));
  status.add("received", camera.sequence.accepted);
  status.add("lost", camera.sequence.lost);
  status.add("out of order", camera.sequence.late);
  status.add("duplicate", camera.sequence.duplicates);
  status.add("restarts", camera.sequence.restarts);
  status.add("counter", any ? counter_text(camera.sequence.state) : "none yet");
  status.add("foreign", camera.foreign);
  status.add("failovers", camera.failovers);
  status.add("malformed", now.source.malformed);
  status.add("last malformed", fault_text(now.reader));
  status.add("accepted despite a fault", now.source.doubtful);
  status.add("refused senders", now.source.refused);
  status.add("kernel drops", now.source.kernel_drops);
  status.add("receive buffer", receive_buffer_text(now.source));
  status.add("overwritten", now.source.overwritten);
  status.add("reattached", now.source.reattached);
  status.add("unknown ids", now.reader.unknown_id_records);
  status.add("unknown format bits", now.source.unknown_format_bits);
  status.add("age of last sample (s)", age_text(any, camera.last_new, now.time));
  status.add("sender", transport::to_string(camera.sender));
  status.add("encoding", any ? camera.encoding : "none yet");
  status.add("format", any ? wire::format_to_words(camera.last_format) : std::string("none yet"));
  status.add("constants known", constants_text(camera.constants));
  status.add("constants ignored", camera.bad_constants);
  status.add("without lens", camera.without_lens);
  status.add("withheld", camera.withheld);
  status.add("dropped", camera.dropped);
  status.add("camera_info", camera_info_text(camera));
  status.add("lens fit residual (px)",
             camera.has_camera_info ? base::fixed_text(camera.fit_residual, 6) : std::string("none"));
  add_stamp_values(status, camera);
  status.add("stamps held", camera.held_stamps);
  status.add("clock steps back", camera.clock_steps);
  status.add("last error", now.source.error.empty() ? std::string("none") : now.source.error);
}

}  // namespace trk_bridge::bridge
