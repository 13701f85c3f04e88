// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The display trk_bridge/Camera in the window of the test.
#pragma once

#include <string>
#include <vector>

#include "tracked_camera.h"
#include "window.h"

namespace trk_bridge::test {

inline const QColor magenta(255, 0, 255);

/// Tolerance of a line in pixels: half its width and the rounding of two renderers.
inline constexpr double line_tolerance = 3;

/// The depths of frusta in the tests, metres.
inline constexpr double near_depth = 0.5, far_depth = 3;

/// Adds a display that draws only the frustum, with lines wide enough to have no gaps.
rviz::Display& add_frustum(const std::string& name, const std::string& info_topic, const std::string& params_topic = "",
                           const QColor& colour = magenta);

/// Waits until the 3D view shows these lines in that colour and nothing else of it.
::testing::AssertionResult becomes(const std::vector<Path>& paths, const QColor& colour = magenta);
/// Waits until only the camera's frustum has that colour.
::testing::AssertionResult becomes(const TrackedCamera& camera, const QColor& colour = magenta);
/// Waits until there is nothing of that colour.
::testing::AssertionResult vanishes(const QColor& colour = magenta);

}  // namespace trk_bridge::test
