// A camera as its tracker tells it, and what it sees: by the document's own equations, on a way that has nothing in
// common with the display's (no K, no D, no inversion).
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "picture.h"
#include "trk_bridge/wire/record.h"
#include "view.h"

namespace trk_bridge::test {

/// Euler angles, image distance and shift in mm, blanks considered.
struct TrackedCamera {
  wire::CameraConstants constants;
  wire::CameraParams params;
};

/// A sound one that looks into the studio, without distortion.
TrackedCamera plain_camera(double x = 0, double pan = 0);

Eigen::Isometry3d pose_of(const TrackedCamera&);

/// The point in the studio at `depth` metres along the optical axis that is seen at `image`, pixels from the upper left
/// corner of the image.
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
