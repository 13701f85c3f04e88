// Whether sixteen numbers are a matrix.
#pragma once

#include <array>

namespace trk_bridge::wire {

/// Whether the bottom row is 0 0 0 1 to 1e-6. An element that is not finite does not count against it: that is a fault
/// of its own, which must not hide behind the guess that this is no matrix.
bool is_affine(const std::array<double, 16>& matrix) noexcept;

}  // namespace trk_bridge::wire
