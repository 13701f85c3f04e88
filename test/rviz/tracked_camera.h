// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A camera as sent by its tracker, and what it sees: with the document's equations, independent of the display's
// calculation (no K, no D, no inversion).
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "picture.h"
#include "trk_bridge/wire/record.h"
#include "view.h"

namespace trk_bridge::test {

/// Euler angles, image distance and shift in mm, with blanks.
struct TrackedCamera {
  wire::CameraConstants constants;
  wire::CameraParams params;
};

/// A valid one that looks into the studio, without distortion.
TrackedCamera plain_camera(double x = 0, double pan = 0);

Eigen::Isometry3d pose_of(const TrackedCamera&);

/// The point in the studio at `depth` metres along the optical axis that is at `image` in the image, in pixels from its
/// upper left corner.
Eigen::Vector3d seen_at(const TrackedCamera&, const Eigen::Vector2d& image, double depth);

/// Points of a line in the studio, metres.
using Path = std::vector<Eigen::Vector3d>;

/// The image's edges at `depth`, closed.
Path outline(const TrackedCamera&, double depth);

/// The outlines at both depths and the edges that join their corners.
std::vector<Path> frustum(const TrackedCamera&, double near, double far);

/// Lines in the studio as the view shows them.
std::vector<Polyline> seen_by(const OrbitView&, const std::vector<Path>&);

}  // namespace trk_bridge::test
