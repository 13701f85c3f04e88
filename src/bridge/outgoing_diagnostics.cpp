// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "outgoing_diagnostics.h"

#include <cmath>
#include <sstream>

#include "base/number_text.h"
#include "base/time_text.h"
#include "diagnostic_text.h"
#include "diagnostics.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge {
namespace {

Finding sending(double rate) { return {Condition::sending, Level::ok, "sending at " + two_decimals(rate) + " Hz"}; }

/// Sets that an input has passed to the sinks.
struct Sets {
  std::uint64_t count = 0;
  std::int64_t last = 0;
};

/// The finding that nothing is sent.
Finding nothing_sent(const Sets& sets, std::int64_t now, const std::string& why) {
  if (sets.count == 0) return {Condition::waiting, Level::stale, "nothing sent yet: " + why};
  return {Condition::nothing_new, Level::warn,
          "nothing sent for " + duration_text(seconds_between(sets.last, now)) + ": " + why};
}

Finding state(const ParamsReport& now, const ParamsReport& before) {
  const Sets sets{now.params.received, now.params.last_received};
  if (sets.count == 0) return nothing_sent(sets, now.time, "no messages on " + now.topic);
  if (seconds_between(sets.last, now.time) > 1) {
    return nothing_sent(sets, now.time, "no newer messages on " + now.topic);
  }
  return sending(rate_between(before.params.received, sets.count, before.time, now.time));
}

Finding state(const TfReport& now, const TfReport& before, double rate) {
  const Sets sets{now.tf.sets, now.tf.last_set};
  if (!now.pose_fault.empty()) return nothing_sent(sets, now.time, "tf: " + now.pose_fault);
  if (now.tf.infos == 0) return nothing_sent(sets, now.time, "no camera_info yet on " + now.info_topic);
  if (now.tf.info_is_refused) {
    // The log shows a condition once: a separate condition is logged even if `waiting` was logged before.
    auto refused = nothing_sent(sets, now.time, "camera_info is refused: " + describe(now.tf.info_fault));
    refused.condition = Condition::bad_camera_info;
    return refused;
  }
  if (sets.count > 0 && seconds_between(sets.last, now.time) <= silence_after(rate)) {
    return sending(rate_between(before.tf.sets, sets.count, before.time, now.time));
  }
  if (now.tf.dropped > before.tf.dropped) return nothing_sent(sets, now.time, camera::describe(now.tf.drop_reason));
  return nothing_sent(sets, now.time, "tf is stale, its newest pose is of " + base::seconds_text(now.last_pose));
}

void add_clock_findings(std::vector<Finding>& found, const TfReport& now, const TfReport& before) {
  if (now.filter.restarts > before.filter.restarts) {
    warn(found, Condition::tf_restarted, "tf was cleared and continues: " + describe(now.filter.last_restart));
  } else if (now.filter.refused > before.filter.refused) {
    warn(found, Condition::tf_refused, "transforms refused: " + describe(now.filter.last_refused));
  }
  const double ahead = seconds_between(0, now.ahead);
  if (found.front().condition == Condition::sending && std::abs(ahead) > 1) {
    warn(found, Condition::clocks_differ,
         "the stamps of tf are " + duration_text(std::abs(ahead)) + (ahead > 0 ? " ahead of" : " behind") +
             " ROS time: check the clocks of all machines, and /use_sim_time where a bag plays");
  }
}

void add_lens_findings(std::vector<Finding>& found, const TfReport& now, const TfReport& before) {
  if (now.tf.bad_lenses > before.tf.bad_lenses) {
    warn(found, Condition::bad_lens, "messages on lens ignored: focus or aperture is not finite");
  }
  if (now.tf.infos == 0 || now.tf.info_is_refused) return;
  if (now.tf.tangential > visible_pixels) {
    warn(found, Condition::tangential_lost,
         "the lens has tangential distortion, which trk cannot represent: up to " + pixels_text(now.tf.tangential) +
             " px");
  }
  if (now.tf.residual > visible_pixels) {
    warn(found, Condition::lens_inexact,
         "k1 and k2 describe the distortion with an error of up to " + pixels_text(now.tf.residual) + " px");
  }
  if (now.tf.aspect > visible_pixels) {
    warn(found, Condition::rows_disagree,
         "fx and fy do not agree with the chip's size: up to " + pixels_text(now.tf.aspect) +
             " px; check chip_width, chip_height and blanks");
  }
}

/// Whether sets are sent completely; none if another finding explains why nothing was written.
std::optional<Finding> state(const SinkReport& now, const SinkReport& before) {
  const auto& sink = now.sink;
  if (now.queue && now.queue->failed) {
    return Finding{Condition::sink_too_slow, Level::error,
                   describe(OutletReason::too_slow) + "; " + std::to_string(now.queue->drops) + " records are missing"};
  }
  if (const auto busy_since = now.state.busy_since; busy_since != 0 && seconds_between(busy_since, now.time) > 1) {
    return Finding{Condition::sink_hangs, Level::error,
                   "nothing is sent: no answer for " + duration_text(seconds_between(busy_since, now.time)) +
                       (now.queue ? "; " + std::to_string(now.queue->queued) + " records wait" : std::string())};
  }
  if (!now.state.cannot_open.empty()) {
    return Finding{Condition::sink_fails, Level::error, "nothing is sent: " + now.state.cannot_open};
  }
  if (sink.fails && sink.last_success < before.time) {
    return Finding{Condition::sink_fails, Level::error, "nothing is sent: " + describe(sink.last_fault)};
  }
  if (const auto failed = sink.failed_sets - before.sink.failed_sets; failed > 0) {
    return Finding{Condition::sink_loses, Level::warn,
                   std::to_string(failed) + " sets were not sent completely: " + describe(sink.last_fault)};
  }
  if (sink.sent.params > before.sink.sent.params) {
    return sending(rate_between(before.sink.sent.params, sink.sent.params, before.time, now.time));
  }
  if (sink.dropped > before.sink.dropped || sink.withheld > before.sink.withheld) return std::nullopt;
  if (sink.sent.params > 0) return sending(0);
  return Finding{Condition::waiting, Level::ok, now.state.is_open ? "open, nothing written yet" : "is being opened"};
}

/// Between two reports.
struct Timing {
  Timing(const DepartureStatistics& now, const DepartureStatistics& before)
      : departures(now.departures - before.departures),
        negative(now.negative - before.negative),
        margin((now.margin_sum - before.margin_sum) / static_cast<double>(departures)),
        age((now.age_sum - before.age_sum) / 1e6 / static_cast<double>(now.sent - before.sent)) {}
  std::string margin_text() const { return departures > 0 ? two_decimals(margin) : "unknown"; }
  std::string age_text() const { return std::isfinite(age) ? two_decimals(age) : "unknown"; }

  std::uint64_t departures, negative;
  double margin;  // fields, mean
  double age;     // ms, mean
};

std::string seconds_of(std::int64_t nanoseconds) { return base::general_text(seconds_between(0, nanoseconds)); }

std::string delay_text(const transport::Delay& delay) {
  if (delay == transport::Delay{delay.position, delay.position, delay.position}) return seconds_of(delay.position);
  return "position " + seconds_of(delay.position) + ", rotation " + seconds_of(delay.rotation) + ", lens " +
         seconds_of(delay.lens);
}

void add_timing_findings(std::vector<Finding>& found, const SinkReport& now, const SinkReport& before) {
  if (!now.departures || !now.form.is_timed() || !now.form.delay || *now.form.delay == transport::Delay{}) return;
  const Timing timing(*now.departures, before.departures.value_or(DepartureStatistics{}));
  // An occasional lost sample is not visible.
  if (timing.negative * 20 <= timing.departures) return;
  warn(found, Condition::delay_too_short,
       std::to_string(timing.negative) + " of " + std::to_string(timing.departures) +
           " sets were older than the delay, because no newer sample had arrived: margin " + timing.margin_text() +
           " fields");
}

void add_outlet_findings(std::vector<Finding>& found, const SinkReport& now, const SinkReport& before) {
  const auto& sink = now.sink;
  if (!now.state.notice.empty()) found.push_back({Condition::sink_notice, Level::ok, now.state.notice});
  if (sink.dropped > before.sink.dropped) {
    warn(found, Condition::dropped, "not sent: " + camera::describe(sink.drop_reason));
  }
  if (sink.withheld > before.sink.withheld) {
    warn(found, Condition::withheld,
         "not sent, cannot be converted to the format: " + camera::describe(sink.withhold_reason));
  }
  if (sink.unsent_id != 0) {
    found.push_back({Condition::id_not_sent, Level::ok,
                     "id " + std::to_string(sink.unsent_id) + " is not sent: the receiver accepts no ids"});
  }
  if (!now.queue || now.queue->failed) return;
  const auto drops = now.queue->drops - (before.queue ? before.queue->drops : 0);
  if (drops > 0) {
    warn(found, Condition::queue_drops,
         std::to_string(drops) + " records not sent: " + describe(OutletReason::outdated));
  }
}

void add_input_values(Status& status, const Sets& sets, double rate, std::int64_t now) {
  status.add("rate (Hz)", two_decimals(rate));
  status.add("sets", sets.count);
  status.add("age of last set (s)", age_text(sets.count > 0, sets.last, now));
}

}  // namespace

SinkReport report_of(const Outlet& outlet, const std::optional<DepartureStatistics>& departures, std::int64_t time) {
  return {outlet.state(), outlet.form(), outlet.statistics(), outlet.queue(), departures, time};
}

std::string timing_text(const DepartureStatistics& now, const DepartureStatistics& before) {
  const Timing timing(now, before);
  return "margin " + timing.margin_text() + " fields, negative " + std::to_string(timing.negative) + " times of " +
         std::to_string(timing.departures) + ", age " + timing.age_text() + " ms";
}

std::vector<Finding> findings(const ParamsReport& now, const ParamsReport& before) {
  std::vector<Finding> found{state(now, before)};
  if (now.params.bad_constants > before.params.bad_constants) {
    warn(found, Condition::bad_constants,
         "constants ignored: " + camera::describe(camera::CameraReason::bad_constants));
  }
  if (now.params.constants == ConstantsOrigin::none && now.params.received > 0) {
    warn(found, Condition::no_constants, "no constants yet: none are sent");
  }
  return found;
}

std::vector<Finding> findings(const TfReport& now, const TfReport& before, double rate) {
  std::vector<Finding> found{state(now, before, rate)};
  add_clock_findings(found, now, before);
  add_lens_findings(found, now, before);
  return found;
}

std::vector<Finding> findings(const SinkReport& now, const SinkReport& before) {
  std::vector<Finding> found;
  if (const auto first = state(now, before)) found.push_back(*first);
  add_outlet_findings(found, now, before);
  add_timing_findings(found, now, before);
  return found;
}

void fill(Status& status, const std::vector<Finding>& found, const ParamsReport& now, const ParamsReport& before) {
  status.hardware_id = now.topic;
  summarize(found, status);
  const auto& params = now.params;
  add_input_values(status, {params.received, params.last_received},
                   rate_between(before.params.received, params.received, before.time, now.time), now.time);
  status.add("received", params.received);
  status.add("received format",
             params.received > 0 ? wire::format_to_words(params.last_format) : std::string("none yet"));
  status.add("constants known", constants_text(params.constants));
  status.add("constants ignored", params.bad_constants);
}

void fill(Status& status, const std::vector<Finding>& found, const TfReport& now, const TfReport& before) {
  status.hardware_id = now.info_topic;
  summarize(found, status);
  const auto& tf = now.tf;
  add_input_values(status, {tf.sets, tf.last_set}, rate_between(before.tf.sets, tf.sets, before.time, now.time),
                   now.time);
  const bool has_lens = tf.infos > 0 && !tf.info_is_refused;
  const auto of_lens = [has_lens](double pixels) { return has_lens ? pixels_text(pixels) : std::string("none"); };
  status.add("dropped", tf.dropped);
  status.add("stamp of last set", tf.last_stamp > 0 ? base::seconds_text(tf.last_stamp) : std::string("none"));
  status.add("tf", now.pose_fault.empty() ? std::string("ok") : now.pose_fault);
  status.add("tf ahead of ROS time (s)", two_decimals(seconds_between(0, now.ahead)));
  status.add("transforms refused", now.filter.refused);
  status.add("tf restarts", now.filter.restarts);
  status.add("last tf restart", now.filter.restarts > 0 ? describe(now.filter.last_restart) : std::string("none"));
  status.add("camera_info received", tf.infos);
  status.add("camera_info refused", tf.refused_infos);
  status.add("age of last camera_info (s)", age_text(tf.infos > 0, tf.last_info, now.time));
  status.add("lens fits", tf.fits);
  status.add("lens fit residual (px)", of_lens(tf.residual));
  status.add("tangential lost (px)", of_lens(tf.tangential));
  status.add("aspect lost (px)", of_lens(tf.aspect));
  status.add("lens messages ignored", tf.bad_lenses);
}

void fill(Status& status, const std::vector<Finding>& found, const SinkReport& now, const SinkReport& before) {
  status.hardware_id = now.state.name;
  summarize(found, status);
  const auto& sink = now.sink;
  const bool ever_failed = sink.failed_sets > 0;
  status.add("sink", now.state.name);
  status.add("rate (Hz)", two_decimals(rate_between(before.sink.sent.params, sink.sent.params, before.time, now.time)));
  status.add("sent", sink.sent.params);
  status.add("constants sent", sink.sent.constants);
  status.add("format", now.form.format ? wire::format_to_words(*now.form.format) : std::string("as received"));
  status.add("id", sink.sent.params > 0 ? std::to_string(sink.last_id) : std::string("none yet"));
  status.add("dropped", sink.dropped);
  status.add("withheld", sink.withheld);
  status.add("constants refused", sink.refused_constants);
  status.add("errors", sink.sent.errors);
  status.add("failed sets", sink.failed_sets);
  status.add("last error", ever_failed ? describe(sink.last_fault) : std::string("none"));
  status.add("age of last error (s)", age_text(ever_failed, sink.last_failure, now.time));
  if (now.departures) {
    const Timing timing(*now.departures, before.departures.value_or(DepartureStatistics{}));
    status.add("delay (s)", delay_text(now.form.delay.value_or(transport::Delay{})));
    status.add("lead (s)", seconds_of(now.form.lead.value_or(0)));
    status.add("margin (fields)", timing.margin_text());
    status.add("negative margins", now.departures->negative);
    status.add("age of what is sent (ms)", timing.age_text());
    status.add("duplicate or late samples left out", now.departures->ignored);
  }
  if (!now.queue) return;
  status.add("queued", now.queue->queued);
  status.add("queue drops", now.queue->drops);
}

}  // namespace trk_bridge::bridge
