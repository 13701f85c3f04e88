// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "alarm.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>

#include "text.h"

namespace trk_bridge::monitor {
namespace {

constexpr double least_window = 1;  // s of arrivals that are needed for rate and jitter

bool has_window(const CameraState& camera) {
  const auto sum = std::accumulate(camera.intervals.begin(), camera.intervals.end(), std::int64_t{0});
  return static_cast<double>(sum) * 1e-9 >= least_window;
}

std::optional<double> loss(const CameraState& camera) { return camera.loss; }

std::optional<double> rate(const CameraState& camera) {
  if (camera.latest && camera.latest->is_silent) return 0;
  return has_window(camera) ? camera.rate : std::nullopt;
}

std::optional<double> jitter(const CameraState& camera) {
  if (!camera.jitter || !has_window(camera)) return {};
  return static_cast<double>(camera.jitter->p99) * 1e-6;
}

std::optional<double> silence(const CameraState& camera) {
  if (!camera.latest) return {};
  return camera.latest->age;
}

struct Quantity {
  std::string_view name, unit;
  std::optional<double> (*of_camera)(const CameraState&);
  double (*of_source)(const State&);  // one of the two
};
constexpr std::array<Quantity, 6> quantities{
    {{"loss", "%", loss, nullptr},
     {"rate", "Hz", rate, nullptr},
     {"jitter", "ms", jitter, nullptr},
     {"silence", "s", silence, nullptr},
     {"malformed", "", nullptr, [](const State& state) { return static_cast<double>(state.recent_malformed); }},
     {"drops", "", nullptr, [](const State& state) { return static_cast<double>(state.recent_drops); }}}};

tl::unexpected<std::string> wrong(std::string_view alarm, const std::string& what) {
  return tl::make_unexpected("\"" + std::string(alarm) + "\": " + what);
}

std::string with_unit(double value, const Quantity& quantity) {
  return fixed(value, 2) + (quantity.unit.empty() ? "" : " " + std::string(quantity.unit));
}

}  // namespace

std::string alarm_quantities() {
  std::string text;
  for (const auto& [name, unit, of_camera, of_source] : quantities) {
    text += (text.empty() ? "" : ", ") + std::string(name) + (unit.empty() ? "" : " (" + std::string(unit) + ")");
  }
  return text;
}

tl::expected<Alarm, std::string> parse_alarm(std::string_view text) {
  Alarm alarm;
  alarm.text = std::string(text);
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string_view::npos) {
    return wrong(text, "no > or <; must be QUANTITY>NUMBER or QUANTITY<NUMBER, such as loss>1%");
  }
  const std::string_view name = text.substr(0, sign);
  const auto* const quantity =
      std::find_if(quantities.begin(), quantities.end(), [name](const Quantity& known) { return known.name == name; });
  if (quantity == quantities.end()) {
    return wrong(text, "quantity \"" + std::string(name) + "\": allowed are " + alarm_quantities());
  }
  alarm.quantity = static_cast<std::size_t>(quantity - quantities.begin());
  alarm.is_above = text[sign] == '>';
  const std::string_view number = text.substr(sign + 1);
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), alarm.limit);
  if (error != std::errc{} || !std::isfinite(alarm.limit) || alarm.limit < 0) {
    return wrong(text, "limit \"" + std::string(number) + "\": allowed is a number from 0 on");
  }
  const std::string_view unit = number.substr(static_cast<std::size_t>(end - number.data()));
  if (!unit.empty() && unit != quantity->unit) {
    return wrong(text, "unit \"" + std::string(unit) + "\" of " + std::string(name) + ": allowed is " +
                           (quantity->unit.empty() ? "none" : std::string(quantity->unit) + " or none"));
  }
  return alarm;
}

std::vector<bridge::Finding> raised(const std::vector<Alarm>& alarms, const State& state) {
  std::vector<bridge::Finding> found;
  for (const auto& alarm : alarms) {
    const auto& quantity = quantities[alarm.quantity];
    const auto check = [&](const std::string& who, std::optional<double> value) {
      if (!value || (alarm.is_above ? *value <= alarm.limit : *value >= alarm.limit)) return;
      found.push_back(
          {bridge::Condition::alarm, bridge::Level::error,
           "ALARM " + alarm.text + ": " + who + std::string(quantity.name) + " " + with_unit(*value, quantity)});
    };
    if (quantity.of_source != nullptr) check("", quantity.of_source(state));
    if (quantity.of_camera == nullptr) continue;
    for (const auto& camera : state.cameras) {
      check("id " + std::to_string(camera.key.id) + ": ", quantity.of_camera(camera));
    }
    if (state.cameras.empty() && quantity.of_camera == silence) check("", state.age);
    if (state.cameras.empty() && quantity.of_camera == rate && state.age >= least_window) check("", 0);
  }
  return found;
}

}  // namespace trk_bridge::monitor
