#include "shared_parameters.h"

namespace trk_bridge::ros1 {

std::optional<wire::CameraConstants> read_constants(ParameterReader& outer, std::vector<std::string>& faults) {
  const auto tree = outer.map("constants");
  if (!tree) return std::nullopt;
  ParameterReader reader(*tree, outer.path() + "constants/", faults);
  wire::CameraConstants constants;
  const std::pair<const char*, std::int32_t*> pixels[] = {
      {"image_width", &constants.image_width}, {"image_height", &constants.image_height},
      {"blank_left", &constants.blank_left},   {"blank_right", &constants.blank_right},
      {"blank_top", &constants.blank_top},     {"blank_bottom", &constants.blank_bottom}};
  for (const auto& [key, into] : pixels) take(reader.integer(key), *into);
  const std::pair<const char*, double*> millimetres[] = {{"chip_width", &constants.chip_width},
                                                         {"chip_height", &constants.chip_height},
                                                         {"fake_chip_width", &constants.fake_chip_width},
                                                         {"fake_chip_height", &constants.fake_chip_height}};
  for (const auto& [key, into] : millimetres) take(reader.number(key), *into);
  for (const char* key : {"image_width", "image_height", "chip_width", "chip_height"}) {
    if (!reader.has(key))
      faults.push_back(reader.path() + key + ": must be given (blanks and fake chip may be left out)");
  }
  reader.refuse_unknown();
  return constants;
}

std::optional<std::uint32_t> read_id(ParameterReader& reader, std::vector<std::string>& faults) {
  const auto id = reader.integer("id");
  if (!id) return std::nullopt;
  if (*id < 0) {
    faults.push_back(reader.path() + "id = " + std::to_string(*id) + ": must be 0 or more");
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(*id);
}

void check_diagnostic_period(ParameterReader& node, std::vector<std::string>& faults) {
  const auto period = node.number("diagnostic_period");
  if (period && !(*period > 0)) {
    faults.push_back(node.path() + "diagnostic_period = " + std::to_string(*period) + ": must be more than 0 seconds");
  }
}

}  // namespace trk_bridge::ros1
