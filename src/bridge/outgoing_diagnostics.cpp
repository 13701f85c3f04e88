#include "outgoing_diagnostics.h"

#include <algorithm>
#include <cstdio>

#include "diagnostic_text.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge {
namespace {

/// "1700000000.020", as stamps are printed elsewhere.
std::string stamp_text(std::int64_t nanoseconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", seconds_between(0, nanoseconds));
  return text;
}

std::string age_text(bool ever, std::int64_t then, std::int64_t now) {
  return ever ? rate_text(seconds_between(then, now)) : std::string("never");
}

Finding sending(double rate) { return {Condition::sending, Level::ok, "sending at " + rate_text(rate) + " Hz"}; }

/// How many sets an input has given to the sinks.
struct Sets {
  std::uint64_t count = 0;
  std::int64_t last = 0;
};

/// Nothing is sent, and why.
Finding nothing_sent(const Sets& sets, std::int64_t now, const std::string& why) {
  if (sets.count == 0) return {Condition::waiting, Level::stale, "nothing sent yet: " + why};
  return {Condition::nothing_new, Level::warn,
          "nothing sent for " + seconds_text(seconds_between(sets.last, now)) + ": " + why};
}

Finding state(const ParamsReport& now, const ParamsReport& before) {
  const Sets sets{now.params.received, now.params.last_received};
  if (sets.count == 0) return nothing_sent(sets, now.time, "no messages on " + now.topic);
  if (seconds_between(sets.last, now.time) > 1) {
    return nothing_sent(sets, now.time, "no newer messages on " + now.topic);
  }
  return sending(rate_between(before.params.received, sets.count, before.time, now.time));
}

/// Why no set can be made of the last pose; empty when one can.
std::string lens_fault(const TfReport& now) {
  if (now.tf.infos == 0) return "no camera_info yet on " + now.info_topic;
  if (now.tf.info_is_refused) return "camera_info is refused: " + describe(now.tf.info_fault);
  return "";
}

Finding state(const TfReport& now, const TfReport& before, double rate) {
  const Sets sets{now.tf.sets, now.tf.last_set};
  if (!now.pose_fault.empty()) return nothing_sent(sets, now.time, "tf: " + now.pose_fault);
  if (const auto fault = lens_fault(now); !fault.empty()) return nothing_sent(sets, now.time, fault);
  if (sets.count > 0 && seconds_between(sets.last, now.time) <= std::max(1.0, 5 / rate)) {
    return sending(rate_between(before.tf.sets, sets.count, before.time, now.time));
  }
  if (now.tf.dropped > before.tf.dropped) return nothing_sent(sets, now.time, camera::describe(now.tf.drop_reason));
  return nothing_sent(sets, now.time, "tf is stale, its newest pose is of " + stamp_text(now.last_pose));
}

void add_lens_findings(std::vector<Finding>& found, const TfReport& now, const TfReport& before) {
  const auto warn = [&found](Condition condition, std::string text) {
    found.push_back({condition, Level::warn, std::move(text)});
  };
  if (now.tf.bad_lenses > before.tf.bad_lenses) {
    warn(Condition::bad_lens, "messages on lens ignored: focus or aperture is not finite");
  }
  if (now.tf.infos == 0 || now.tf.info_is_refused) return;
  if (now.tf.tangential > visible_pixels) {
    warn(Condition::tangential_lost,
         "the lens has tangential distortion, which trk cannot carry: up to " + pixels_text(now.tf.tangential) + " px");
  }
  if (now.tf.residual > visible_pixels) {
    warn(Condition::lens_inexact, "k1 and k2 describe the distortion to " + pixels_text(now.tf.residual) + " px only");
  }
  if (now.tf.aspect > visible_pixels) {
    warn(Condition::rows_disagree, "fx and fy do not agree with the chip's size: up to " + pixels_text(now.tf.aspect) +
                                       " px; check chip_width, chip_height and blanks");
  }
}

/// Whether sets go out whole; none where none were written because of what else is found.
std::optional<Finding> state(const SinkReport& now, const SinkReport& before) {
  const auto& sink = now.sink;
  if (now.queue && now.queue->failed) {
    return Finding{Condition::sink_too_slow, Level::error,
                   describe(OutletReason::too_slow) + "; " + std::to_string(now.queue->drops) + " records are missing"};
  }
  if (sink.fails && sink.last_success < before.time) {
    return Finding{Condition::sink_fails, Level::error, "nothing goes out: " + describe(sink.last_fault)};
  }
  if (const auto failed = sink.failed_sets - before.sink.failed_sets; failed > 0) {
    return Finding{Condition::sink_loses, Level::warn,
                   std::to_string(failed) + " sets did not go out whole: " + describe(sink.last_fault)};
  }
  if (sink.sent.params > before.sink.sent.params) {
    return sending(rate_between(before.sink.sent.params, sink.sent.params, before.time, now.time));
  }
  if (sink.dropped > before.sink.dropped || sink.withheld > before.sink.withheld) return std::nullopt;
  if (sink.sent.params == 0) return Finding{Condition::waiting, Level::ok, "open, nothing written yet"};
  return sending(0);
}

void add_outlet_findings(std::vector<Finding>& found, const SinkReport& now, const SinkReport& before) {
  const auto& sink = now.sink;
  if (sink.dropped > before.sink.dropped) {
    found.push_back({Condition::dropped, Level::warn, "not sent: " + camera::describe(sink.drop_reason)});
  }
  if (sink.withheld > before.sink.withheld) {
    found.push_back({Condition::withheld, Level::warn,
                     "not sent, cannot be converted to the format: " + camera::describe(sink.withhold_reason)});
  }
  if (sink.left_out_id != 0) {
    found.push_back({Condition::id_left_out, Level::ok,
                     "id " + std::to_string(sink.left_out_id) + " is left out: the receiver takes none"});
  }
  if (!now.queue || now.queue->failed) return;
  const auto drops = now.queue->drops - (before.queue ? before.queue->drops : 0);
  if (drops > 0) {
    found.push_back({Condition::queue_drops, Level::warn,
                     std::to_string(drops) + " records not sent: " + describe(OutletReason::outdated)});
  }
}

void add_input_values(Status& status, const Sets& sets, double rate, std::int64_t now) {
  status.add("rate (Hz)", rate_text(rate));
  status.add("sets", sets.count);
  status.add("age of last set (s)", age_text(sets.count > 0, sets.last, now));
}

const char* constants_text(const ParamsToTrkStatistics& params) {
  if (!params.constants_known) return "no";
  return params.constants_received ? "received" : "from the parameter";
}

}  // namespace

SinkReport report_of(const Outlet& outlet, std::int64_t time) {
  return {outlet.name(), outlet.form(), outlet.statistics(), outlet.queue(), time};
}

std::vector<Finding> findings(const ParamsReport& now, const ParamsReport& before) {
  std::vector<Finding> found{state(now, before)};
  if (now.params.bad_constants > before.params.bad_constants) {
    found.push_back({Condition::bad_constants, Level::warn,
                     "constants ignored: " + camera::describe(camera::CameraReason::bad_constants)});
  }
  if (!now.params.constants_known && now.params.received > 0) {
    found.push_back({Condition::no_constants, Level::warn, "no constants yet: none are sent"});
  }
  return found;
}

std::vector<Finding> findings(const TfReport& now, const TfReport& before, double rate) {
  std::vector<Finding> found{state(now, before, rate)};
  add_lens_findings(found, now, before);
  return found;
}

std::vector<Finding> findings(const SinkReport& now, const SinkReport& before) {
  std::vector<Finding> found;
  if (const auto first = state(now, before)) found.push_back(*first);
  add_outlet_findings(found, now, before);
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
  status.add("constants known", constants_text(params));
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
  status.add("stamp of last set", tf.last_stamp > 0 ? stamp_text(tf.last_stamp) : std::string("none"));
  status.add("tf", now.pose_fault.empty() ? std::string("ok") : now.pose_fault);
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
  status.hardware_id = now.name;
  summarize(found, status);
  const auto& sink = now.sink;
  const bool ever_failed = sink.failed_sets > 0;
  status.add("sink", now.name);
  status.add("rate (Hz)", rate_text(rate_between(before.sink.sent.params, sink.sent.params, before.time, now.time)));
  status.add("sent", sink.sent.params);
  status.add("constants sent", sink.sent.constants);
  status.add("format", now.form.format ? wire::format_to_words(*now.form.format) : std::string("as received"));
  status.add("id", sink.sent.params > 0 ? std::to_string(sink.last_id) : std::string("none yet"));
  status.add("dropped", sink.dropped);
  status.add("withheld", sink.withheld);
  status.add("errors", sink.sent.errors);
  status.add("failed sets", sink.failed_sets);
  status.add("last error", ever_failed ? describe(sink.last_fault) : std::string("none"));
  status.add("age of last error (s)", age_text(ever_failed, sink.last_failure, now.time));
  if (!now.queue) return;
  status.add("queued", now.queue->queued);
  status.add("queue drops", now.queue->drops);
}

}  // namespace trk_bridge::bridge
