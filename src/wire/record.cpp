// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/record.h"

#include "trk_bridge/wire/fields.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::wire {

bool operator==(const CameraParams& a, const CameraParams& b) noexcept {
  const bool same_transform = has(a.format, euler) ? same_fields(a.euler, b.euler) : a.matrix == b.matrix;
  return same_transform && same_fields(a, b);
}

bool operator==(const CameraConstants& a, const CameraConstants& b) noexcept { return same_fields(a, b); }

}  // namespace trk_bridge::wire
