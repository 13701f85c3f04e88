#include "shared_parameters.h"

#include "trk_bridge/wire/fields.h"

namespace trk_bridge::ros1 {

std::optional<wire::CameraConstants> read_constants(ParameterReader& outer, std::vector<std::string>& faults) {
  const auto tree = outer.map("constants");
  if (!tree) return std::nullopt;
  ParameterReader reader(*tree, outer.path() + "constants/", faults);
  wire::CameraConstants constants;
  const auto read_pixels = [&](const wire::Field& field, std::int32_t& into) {
    take(reader.integer(field.name), into);
  };
  const auto read_number = [&](const wire::Field& field, double& into) { take(reader.number(field.name), into); };
  wire::for_each_image_field(read_pixels, constants);
  wire::for_each_chip_field(read_number, constants);
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
