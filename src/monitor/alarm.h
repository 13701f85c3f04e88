// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Alarms that a user defines: `loss>1%`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "model.h"

namespace trk_bridge::monitor {

/// One limit of one quantity.
struct Alarm {
  std::string text;  ///< as given
  std::size_t quantity = 0;
  bool is_above = true;  ///< raised above the limit, else below
  double limit = 0;      ///< in the quantity's unit
};

/// QUANTITY, `>` or `<`, NUMBER and the unit, which may be left out: `loss>1%`, `rate<49.5`, `jitter>2ms`,
/// `silence>0.5s`, `malformed>0`, `drops>0`. The error names the part, its value and what is allowed.
tl::expected<Alarm, std::string> parse_alarm(std::string_view);
/// "loss (%), rate (Hz), …": for help texts.
std::string alarm_quantities();

/// The raised alarms of all cameras, as findings with level error. Loss, malformed records and drops are those of the
/// last seconds (Model::findings_span), rate and jitter (99th percentile) those of the window of arrivals, which must
/// cover at least one second. A silent camera has rate 0; before the first camera, the source counts as silent.
std::vector<bridge::Finding> raised(const std::vector<Alarm>&, const State&);

}  // namespace trk_bridge::monitor
