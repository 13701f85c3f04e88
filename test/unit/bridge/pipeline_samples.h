// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Samples for a CameraPipeline.
#pragma once

#include <cstdint>

#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

inline constexpr std::int64_t second = 1'000'000'000;
inline constexpr std::int64_t today = 1'700'000'000 * second;
inline constexpr std::int64_t field = 20'000'000;

inline wire::CameraConstants constants(std::uint32_t id = 0) {
  return {id, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39};
}

/// Euler, with an image distance: needs no constants.
inline wire::CameraParams params(std::uint64_t counter, std::uint32_t id = 0) {
  wire::CameraParams p;
  p.id = id;
  p.format = wire::euler;
  p.euler = {1, 2, 3, 30, -5, 0};
  p.fov = 10;
  p.counter = counter;
  return p;
}

inline transport::Sample sample(const wire::Record& record, std::int64_t arrival = today) {
  transport::Sample s;
  s.record = record;
  s.arrival = arrival;
  return s;
}

}  // namespace trk_bridge::bridge
