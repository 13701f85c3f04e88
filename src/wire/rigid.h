// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Whether sixteen numbers are an affine matrix.
#pragma once

#include <array>

namespace trk_bridge::wire {

/// Whether the bottom row is 0 0 0 1 to 1e-6. An element that is not finite is accepted: it is reported as another
/// fault, which the layout detection must not hide.
bool is_affine(const std::array<double, 16>& matrix) noexcept;

}  // namespace trk_bridge::wire
