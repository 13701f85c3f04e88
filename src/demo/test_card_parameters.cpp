// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "test_card_parameters.h"

#include <utility>

#include "ros/parameter_reader.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::demo {

TestCardParameters read_test_card_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera) {
  ros1::ParameterReader reader(tree);
  TestCardParameters parameters;
  parameters.optical_frame = ros1::default_frames(camera).optical;
  reader.number("rate", parameters.rate, {0.1, 240, "Hz"});
  reader.number("video_delay", parameters.video_delay, {-1, 1, "seconds"});
  reader.flag("random_video_delay", parameters.random_video_delay);
  reader.parsed("studio_frame", parameters.studio_frame, ros1::parse_frame);
  reader.parsed("optical_frame", parameters.optical_frame, ros1::parse_frame);
  reader.diagnostic_period();
  Place& place = parameters.place;
  reader.number("x", place.x, {-1e4, 1e4, "m"});
  reader.number("y", place.y, {-1e4, 1e4, "m"});
  reader.number("width", place.width, {0, 1000, "m"});
  reader.number("depth", place.depth, {0, 1000, "m"});
  reader.number("height", place.height, {0, 1000, "m"});
  reader.number("spacing", place.spacing, {0.01, 1000, "m"});

  if (reader.are_valid({"optical_frame", "studio_frame"}) && parameters.optical_frame == parameters.studio_frame) {
    reader.fault("optical_frame", ros1::shown(parameters.optical_frame), "must differ from studio_frame");
  }
  if (reader.are_valid({"random_video_delay"}) && parameters.random_video_delay && reader.has("video_delay")) {
    reader.fault("video_delay", "must not be set together with random_video_delay");
  }
  const std::pair<const char*, double> sizes[] = {
      {"width", place.width}, {"depth", place.depth}, {"height", place.height}};
  for (const auto& [key, size] : sizes) {
    if (reader.are_valid({key, "spacing"}) && size > most_cells * place.spacing) {
      reader.fault(key, ros1::shown(size), "must not be more than " + std::to_string(most_cells) + " times spacing");
    }
  }
  reader.finish();
  return parameters;
}

}  // namespace trk_bridge::demo
