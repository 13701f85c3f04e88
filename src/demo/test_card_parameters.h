// The parameters of test_card.
#pragma once

#include <string>

#include <xmlrpcpp/XmlRpcValue.h>

#include "test_card_figure.h"

namespace trk_bridge::demo {

inline constexpr double most_random_video_delay = 0.08;  // s

struct TestCardParameters {
  double rate = 25;                 ///< images a second at most, Hz
  double video_delay = 0;           ///< s that an image's stamp is later than what it shows
  bool random_video_delay = false;  ///< instead: one that the node picks, up to most_random_video_delay
  std::string studio_frame = "studio", optical_frame;
  Place place;
};

/// From a node's private parameters; `camera` is its camera's name. Throws ros1::ParameterError with every fault.
TestCardParameters read_test_card_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera);

}  // namespace trk_bridge::demo
