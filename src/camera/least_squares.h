// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Linear least squares for the lens fits. Not a template: Eigen takes seconds to compile it, and here it is compiled
// once.
#pragma once

#include <Eigen/Core>

namespace trk_bridge::camera {

/// The largest sizes; with fixed maximum sizes, nothing allocates.
inline constexpr int most_equations = 64, most_unknowns = 6;
using Terms = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_equations, most_unknowns>;
using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_equations, 1>;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_unknowns, 1>;

/// The x that minimises |`terms` * x - `wanted`|, by QR with column pivoting. Of columns that are linearly dependent
/// within rounding, only the most significant are used; x is 0 for the others. `terms` has at least as many rows as
/// columns.
[[nodiscard]] Unknowns least_squares(const Terms& terms, const Values& wanted) noexcept;

}  // namespace trk_bridge::camera
