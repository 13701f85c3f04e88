// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The parameters of test_card.
#pragma once

#include <string>

#include <xmlrpcpp/XmlRpcValue.h>

#include "test_card_figure.h"

namespace trk_bridge::demo {

inline constexpr double most_random_video_delay = 0.08;  // s

struct TestCardParameters {
  double rate = 25;                 ///< largest rate of images, Hz
  double video_delay = 0;           ///< s by which the stamp of an image is later than what it shows
  bool random_video_delay = false;  ///< the node chooses a random delay instead, up to most_random_video_delay
  std::string studio_frame = "studio", optical_frame;
  Place place;
};

/// From the private parameters of a node; `camera` is the name of its camera. Throws ros1::ParameterError with all
/// faults.
TestCardParameters read_test_card_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera);

}  // namespace trk_bridge::demo
