// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The test card as markers for rviz.
#pragma once

#include <string>

#include <visualization_msgs/MarkerArray.h>

#include "test_card_figure.h"

namespace trk_bridge::demo {

/// Namespaces `floor`, `wall`, `points` and `labels`; stamp 0, valid at any time.
visualization_msgs::MarkerArray markers_of(const Figure&, const std::string& studio_frame);

}  // namespace trk_bridge::demo
