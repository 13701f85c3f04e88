#include "test_card_parameters.h"

#include <cmath>
#include <sstream>
#include <vector>

#include "ros/faults.h"
#include "ros/shared_parameters.h"
#include "ros/parameter_reader.h"

namespace trk_bridge::demo {
namespace {

using ros1::Faults;

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void check_range(const char* key, double value, double least, double most, const char* unit, Faults& faults) {
  if (value >= least && value <= most) return;
  faults.add(key, number(value), "must be " + number(least) + " to " + number(most) + ' ' + unit);
}

void check_place(const Place& place, Faults& faults) {
  constexpr double farthest = 1e4, largest = 1000, closest = 0.01;
  check_range("x", place.x, -farthest, farthest, "m", faults);
  check_range("y", place.y, -farthest, farthest, "m", faults);
  check_range("spacing", place.spacing, closest, largest, "m", faults);
  const std::pair<const char*, double> sizes[] = {
      {"width", place.width}, {"depth", place.depth}, {"height", place.height}};
  for (const auto& [key, size] : sizes) {
    check_range(key, size, 0, largest, "m", faults);
    if (size > most_cells * place.spacing) {
      faults.add(key, number(size), "must not be more than " + std::to_string(most_cells) + " times spacing");
    }
  }
}

}  // namespace

Parameters read_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera) {
  Parameters parameters;
  parameters.optical_frame = camera + "_optical";
  Faults faults("~");
  ros1::ParameterReader reader(tree, "~", faults.lines);
  ros1::take(reader.number("rate"), parameters.rate);
  ros1::take(reader.text("studio_frame"), parameters.studio_frame);
  ros1::take(reader.text("optical_frame"), parameters.optical_frame);
  Place& place = parameters.place;
  ros1::take(reader.number("x"), place.x);
  ros1::take(reader.number("y"), place.y);
  ros1::take(reader.number("width"), place.width);
  ros1::take(reader.number("depth"), place.depth);
  ros1::take(reader.number("height"), place.height);
  ros1::take(reader.number("spacing"), place.spacing);
  reader.refuse_unknown();

  check_range("rate", parameters.rate, 0.1, 240, "Hz", faults);
  ros1::check_frame("studio_frame", parameters.studio_frame, faults);
  if (ros1::check_frame("optical_frame", parameters.optical_frame, faults) &&
      parameters.optical_frame == parameters.studio_frame) {
    faults.add("optical_frame", ros1::quoted(parameters.optical_frame), "must differ from studio_frame");
  }
  check_place(place, faults);
  if (!faults.lines.empty()) throw ros1::ParameterError(faults.lines);
  return parameters;
}

}  // namespace trk_bridge::demo
