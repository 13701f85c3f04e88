// Reading what the parameters of several nodes have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parameter_reader.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

template <typename T, typename U>
void take(std::optional<T> given, U& into) {
  if (given) into = *std::move(given);
}

/// The map `constants`; none when it is not given.
std::optional<wire::CameraConstants> read_constants(ParameterReader& outer, std::vector<std::string>& faults);

/// `id`; none when it is not given.
std::optional<std::uint32_t> read_id(ParameterReader& reader, std::vector<std::string>& faults);

/// diagnostic_updater's own parameter: seconds between diagnostics.
void check_diagnostic_period(ParameterReader& node, std::vector<std::string>& faults);

}  // namespace trk_bridge::ros1
