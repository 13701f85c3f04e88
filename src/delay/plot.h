// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Draws a measurement.
#pragma once

#include <string>

#include "meter.h"

namespace trk_bridge::delay {

/// An SVG. Above: how fast the picture and tracking turned about the axis that moved most, with the original stamps and
/// with tracking delayed, in the ten seconds around the fastest motion. Below: the correlation over all delays. The
/// measurement must have speeds. `title` is written at the top.
std::string to_svg(const Measurement&, const std::string& title);

}  // namespace trk_bridge::delay
