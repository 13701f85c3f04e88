#include <algorithm>
#include <cmath>

#include "faults.h"
#include "endpoints/presets.h"
#include "ros_to_trk_parameters.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

constexpr const char* default_format = "euler";

void check_sinks(const std::vector<std::string>& sinks, Faults& faults) {
  if (sinks.empty()) {
    faults.add("sinks", "[]", "must be given: endpoint URLs such as udp://host:7000, shm:7 or file:take.trk");
  }
  for (auto sink = sinks.begin(); sink != sinks.end(); ++sink) {
    if (const auto endpoint = endpoints::parse_sink(*sink); !endpoint) {
      faults.add("sinks", quoted(*sink), endpoint.error());
    } else if (std::find(sinks.begin(), sink, *sink) != sink) {
      faults.add("sinks", quoted(*sink), "is given twice");
    }
  }
}

void check_format(const RosToTrkParameters& parameters, Faults& faults) {
  if (parameters.format && parameters.preset) {
    faults.add("preset", quoted(*parameters.preset), "must not be given with format, which it stands for");
    return;
  }
  if (parameters.preset) {
    if (const auto preset = endpoints::find_preset(*parameters.preset); !preset) {
      faults.add("preset", quoted(*parameters.preset), preset.error());
    }
    return;
  }
  if (!parameters.format) return;
  const auto mask = wire::format_from_words(*parameters.format);
  if (!mask) faults.add("format", quoted(*parameters.format), mask.error());
}

void check_length(const char* key, const std::optional<double>& length, bool needed, Faults& faults) {
  if (!length) {
    if (needed) faults.add(key, "(none)", "must be given with input tf: the chip's size in mm");
  } else if (!std::isfinite(*length) || !(*length > 0)) {
    faults.add(key, std::to_string(*length), "must be more than 0 mm");
  }
}

void check_not_negative(const char* key, double value, Faults& faults) {
  if (std::isfinite(value) && value >= 0) return;
  faults.add(key, std::to_string(value), "must be 0 or more");
}

void check_tf(const RosToTrkParameters& parameters, Faults& faults) {
  if (!std::isfinite(parameters.rate) || parameters.rate < 1 || parameters.rate > 1000) {
    faults.add("rate", std::to_string(parameters.rate), "must be 1 to 1000 Hz");
  }
  const bool needed = parameters.input == "tf";
  check_length("chip_width", parameters.chip_width, needed, faults);
  check_length("chip_height", parameters.chip_height, needed, faults);
  check_not_negative("blank_left", parameters.blank_left, faults);
  check_not_negative("blank_right", parameters.blank_right, faults);
  check_not_negative("blank_top", parameters.blank_top, faults);
  check_not_negative("blank_bottom", parameters.blank_bottom, faults);
  const bool sound = check_frame("studio_frame", parameters.studio_frame, faults);
  if (check_frame("camera_frame", parameters.camera_frame, faults) && sound &&
      parameters.camera_frame == parameters.studio_frame) {
    faults.add("camera_frame", quoted(parameters.camera_frame), "must differ from studio_frame");
  }
  check_not_negative("focdist", parameters.focdist, faults);
  check_not_negative("aperture", parameters.aperture, faults);
}

}  // namespace

std::vector<std::string> validate(const RosToTrkParameters& parameters) {
  Faults faults("~");
  check_name(parameters.name, faults);
  check_sinks(parameters.sinks, faults);
  if (parameters.input != "params" && parameters.input != "tf") {
    faults.add("input", quoted(parameters.input), "must be params or tf");
  }
  check_format(parameters, faults);
  check_queue_size(parameters.queue_size, faults);
  if (parameters.constants) check_constants(*parameters.constants, faults);
  check_tf(parameters, faults);
  return std::move(faults.lines);
}

OutgoingForm form_of(const RosToTrkParameters& parameters) {
  OutgoingForm form;
  form.id = parameters.id;
  if (parameters.preset) {
    const auto preset = endpoints::find_preset(*parameters.preset).value();
    form.format = preset.format;
    form.sends_id = preset.sends_id;
  } else {
    form.format = wire::format_from_words(parameters.format.value_or(default_format)).value();
  }
  return form;
}

}  // namespace trk_bridge::ros1
