#include "outgoing_diagnostics.h"

#include <algorithm>
#include <cstdio>

#include "diagnostic_text.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

using diagnostic_msgs::DiagnosticStatus;

/// "1700000000.020", as stamps are printed elsewhere.
std::string stamp_text(std::int64_t nanoseconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", seconds_between(0, nanoseconds));
  return text;
}

std::string age_text(bool ever, std::int64_t then, std::int64_t now) {
  return ever ? rate_text(seconds_between(then, now)) : std::string("never");
}

double age_of(const OutgoingStatistics& outgoing, std::int64_t now) { return seconds_between(outgoing.last_set, now); }

Finding sending(double rate) {
  return {Condition::sending, DiagnosticStatus::OK, "sending at " + rate_text(rate) + " Hz"};
}

/// Nothing is sent, and why.
Finding nothing_sent(const OutgoingStatistics& outgoing, std::int64_t now, const std::string& why) {
  if (outgoing.sets == 0) return {Condition::waiting, DiagnosticStatus::STALE, "nothing sent yet: " + why};
  return {Condition::nothing_new, DiagnosticStatus::WARN,
          "nothing sent for " + seconds_text(age_of(outgoing, now)) + ": " + why};
}

void add_outgoing_findings(std::vector<Finding>& found, const OutgoingStatistics& now,
                           const OutgoingStatistics& before) {
  if (now.dropped > before.dropped) {
    found.push_back({Condition::dropped, DiagnosticStatus::WARN, "not sent: " + camera::describe(now.drop_reason)});
  }
  if (now.withheld > before.withheld) {
    found.push_back({Condition::withheld, DiagnosticStatus::WARN,
                     "not sent, cannot be told in the format: " + camera::describe(now.withhold_reason)});
  }
  if (now.left_out_id != 0) {
    found.push_back({Condition::id_left_out, DiagnosticStatus::OK,
                     "id " + std::to_string(now.left_out_id) + " is left out: the receiver takes none"});
  }
}

Finding state(const ParamsReport& now, const ParamsReport& before) {
  const auto& outgoing = now.params.outgoing;
  if (now.params.received == 0) return nothing_sent(outgoing, now.time, "no messages on " + now.topic);
  if (outgoing.sets > 0 && age_of(outgoing, now.time) <= 1) {
    return sending(rate_between(before.params.outgoing.sets, outgoing.sets, before.time, now.time));
  }
  const bool come = now.params.received > before.params.received;
  return nothing_sent(outgoing, now.time,
                      come ? "messages come, but none can be sent" : "no newer messages on " + now.topic);
}

/// Why no set can be made of the last pose; empty when one can.
std::string lens_fault(const TfReport& now) {
  if (now.tf.infos == 0) return "no camera_info yet on " + now.info_topic;
  if (now.tf.info_is_refused) return "camera_info is refused: " + describe(now.tf.info_fault);
  return "";
}

Finding state(const TfReport& now, const TfReport& before, double rate) {
  const auto& outgoing = now.tf.outgoing;
  if (!now.pose_fault.empty()) return nothing_sent(outgoing, now.time, "tf: " + now.pose_fault);
  if (const auto fault = lens_fault(now); !fault.empty()) return nothing_sent(outgoing, now.time, fault);
  if (outgoing.sets > 0 && age_of(outgoing, now.time) <= std::max(1.0, 5 / rate)) {
    return sending(rate_between(before.tf.outgoing.sets, outgoing.sets, before.time, now.time));
  }
  if (outgoing.withheld > before.tf.outgoing.withheld) {
    return nothing_sent(outgoing, now.time, "the camera cannot be told in the format");
  }
  return nothing_sent(outgoing, now.time, "tf is stale, its newest pose is of " + stamp_text(now.last_pose));
}

void add_lens_findings(std::vector<Finding>& found, const TfReport& now, const TfReport& before) {
  const auto warn = [&found](Condition condition, std::string text) {
    found.push_back({condition, DiagnosticStatus::WARN, std::move(text)});
  };
  if (now.tf.bad_lenses > before.tf.bad_lenses) {
    warn(Condition::bad_lens, "messages on lens ignored: focus or aperture is not finite");
  }
  if (now.tf.infos == 0 || now.tf.info_is_refused) return;
  if (now.tf.tangential > visible_pixels) {
    warn(Condition::tangential_lost,
         "the lens has tangential distortion, which trk cannot tell: up to " + pixels_text(now.tf.tangential) + " px");
  }
  if (now.tf.residual > visible_pixels) {
    warn(Condition::lens_inexact,
         "k1 and k2 tell the distortion to " + pixels_text(now.tf.residual) + " px, no better");
  }
  if (now.tf.aspect > visible_pixels) {
    warn(Condition::rows_disagree, "fx and fy do not agree with the chip's size: up to " + pixels_text(now.tf.aspect) +
                                       " px; check chip_width, chip_height and blanks");
  }
}

void add_outgoing_values(diagnostic_updater::DiagnosticStatusWrapper& status, const OutgoingStatistics& now,
                         const OutgoingForm& form, double rate, const std::string& age) {
  status.add("rate (Hz)", rate_text(rate));
  status.add("sets", now.sets);
  status.add("age of last set (s)", age);
  status.add("format", wire::format_to_words(form.format));
  status.add("id", now.sets > 0 ? std::to_string(now.last_id) : std::string("none yet"));
  status.add("dropped", now.dropped);
  status.add("withheld", now.withheld);
}

const char* constants_text(const ParamsToTrkStatistics& params) {
  if (!params.constants_known) return "no";
  return params.constants_received ? "received" : "from the parameter";
}

}  // namespace

std::vector<Finding> findings(const ParamsReport& now, const ParamsReport& before) {
  std::vector<Finding> found{state(now, before)};
  add_outgoing_findings(found, now.params.outgoing, before.params.outgoing);
  if (now.params.bad_constants > before.params.bad_constants) {
    found.push_back({Condition::bad_constants, DiagnosticStatus::WARN,
                     "constants ignored: " + camera::describe(camera::CameraReason::bad_constants)});
  }
  if (!now.params.constants_known && now.params.received > 0) {
    found.push_back({Condition::no_constants, DiagnosticStatus::WARN, "no constants yet: receivers are told none"});
  }
  return found;
}

std::vector<Finding> findings(const TfReport& now, const TfReport& before, double rate) {
  std::vector<Finding> found{state(now, before, rate)};
  add_outgoing_findings(found, now.tf.outgoing, before.tf.outgoing);
  add_lens_findings(found, now, before);
  return found;
}

std::vector<Finding> findings(const SinkReport& now, const SinkReport& before) {
  const auto& sink = now.sink;
  if (sink.fails && sink.last_success < before.time) {
    return {{Condition::sink_fails, DiagnosticStatus::ERROR, "nothing goes out: " + describe(sink.last_fault)}};
  }
  const std::uint64_t failed = sink.failed_sets - before.sink.failed_sets;
  if (failed > 0) {
    return {{Condition::sink_loses, DiagnosticStatus::WARN,
             std::to_string(failed) + " sets did not go out whole: " + describe(sink.last_fault)}};
  }
  if (sink.counts.params == 0) return {{Condition::waiting, DiagnosticStatus::OK, "open, nothing written yet"}};
  return {sending(rate_between(before.sink.counts.params, sink.counts.params, before.time, now.time))};
}

void fill(diagnostic_updater::DiagnosticStatusWrapper& status, const std::vector<Finding>& found,
          const ParamsReport& now, const ParamsReport& before, const OutgoingForm& form) {
  status.hardware_id = now.topic;
  summarize(found, status);
  const auto& outgoing = now.params.outgoing;
  add_outgoing_values(status, outgoing, form,
                      rate_between(before.params.outgoing.sets, outgoing.sets, before.time, now.time),
                      age_text(outgoing.sets > 0, outgoing.last_set, now.time));
  status.add("received", now.params.received);
  status.add("received format",
             now.params.received > 0 ? wire::format_to_words(now.params.last_format) : std::string("none yet"));
  status.add("constants known", constants_text(now.params));
  status.add("constants ignored", now.params.bad_constants);
}

void fill(diagnostic_updater::DiagnosticStatusWrapper& status, const std::vector<Finding>& found, const TfReport& now,
          const TfReport& before, const OutgoingForm& form) {
  status.hardware_id = now.info_topic;
  summarize(found, status);
  const auto& tf = now.tf;
  add_outgoing_values(status, tf.outgoing, form,
                      rate_between(before.tf.outgoing.sets, tf.outgoing.sets, before.time, now.time),
                      age_text(tf.outgoing.sets > 0, tf.outgoing.last_set, now.time));
  const bool has_lens = tf.infos > 0 && !tf.info_is_refused;
  const auto of_lens = [has_lens](double pixels) { return has_lens ? pixels_text(pixels) : std::string("none"); };
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

void fill(diagnostic_updater::DiagnosticStatusWrapper& status, const std::vector<Finding>& found, const SinkReport& now,
          const SinkReport& before) {
  status.hardware_id = now.name;
  summarize(found, status);
  const auto& sink = now.sink;
  const bool ever_failed = sink.failed_sets > 0;
  status.add("sink", now.name);
  status.add("rate (Hz)",
             rate_text(rate_between(before.sink.counts.params, sink.counts.params, before.time, now.time)));
  status.add("sent", sink.counts.params);
  status.add("constants sent", sink.counts.constants);
  status.add("errors", sink.counts.errors);
  status.add("failed sets", sink.failed_sets);
  status.add("last error", ever_failed ? describe(sink.last_fault) : std::string("none"));
  status.add("age of last error (s)", age_text(ever_failed, sink.last_failure, now.time));
}

}  // namespace trk_bridge::ros1
