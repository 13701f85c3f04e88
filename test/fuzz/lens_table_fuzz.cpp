// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any text as a lens table, and the lenses of a valid one at any counts.
#include <cmath>
#include <cstdlib>
#include <string>

#include "fuzz.h"
#include "lens/table.h"

namespace {

using namespace trk_bridge;
using test::claim;

const std::string file_name = "lens.yaml";

void claim_error(const std::string& error, std::size_t lines) {
  const std::string begin = file_name + ":";
  claim(error.size() > begin.size() && error.compare(0, begin.size(), begin) == 0, "an error without the file's name");
  char* end = nullptr;
  const auto line = std::strtoul(error.c_str() + begin.size(), &end, 10);
  claim(line >= 1 && line <= lines + 1 && *end == ':' && end[1] != '\0', "an error without a line: " + error);
}

void claim_lens(const camera::Lens& lens) {
  claim(std::isfinite(lens.image_distance) && lens.image_distance > 0, "an image distance that no lens has");
  claim(lens.center_shift.allFinite() && std::isfinite(lens.k1) && std::isfinite(lens.k2), "a lens that is not finite");
  claim(std::isfinite(lens.focdist) && lens.focdist >= 0 && lens.aperture == 0, "a distance that is none");
}

/// A lens at a position is that of a position again, where focus alone does not decide that.
void claim_way_back(const lens::Table& table, const lens::Position& at) {
  const auto lens = table.lens_at(at);
  if (!lens) return;
  claim_lens(*lens);
  const auto back = table.position_of(*lens);
  const auto& points = table.points().points;
  const double first = points.front().lens.image_distance, last = points.back().lens.image_distance;
  const bool is_flat = std::abs(last - first) <= 1e-6 * first;
  if (points.front().at.focus == points.back().at.focus && !is_flat) {
    claim(back.has_value(), "a lens of the table that has no position");
  }
  if (!back) return;
  claim(std::isfinite(back->focus) && back->zoom >= table.first().zoom && back->zoom <= table.last().zoom,
        "a position beyond the table");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string yaml(reinterpret_cast<const char*>(data), size);
  const auto table = lens::Table::from_yaml(yaml, file_name);
  if (!table) {
    std::size_t lines = 1;
    for (const char c : yaml) lines += c == '\n' || c == '\r' ? 1 : 0;
    claim_error(table.error(), lines);
    return 0;
  }
  const lens::Position first = table->first(), last = table->last();
  claim(std::isfinite(first.zoom) && first.zoom < last.zoom && first.focus <= last.focus, "a range that is none");
  if (table->constants()) claim(camera::check(*table->constants()).has_value(), "constants of no picture");
  for (const lens::Point& point : table->points().points) {
    claim_lens(point.lens);
    const auto lens = table->lens_at(point.at);
    claim(lens || table->has_distances(), "no lens at a point of the table");
    const double wanted = point.lens.image_distance;
    claim(!lens || std::abs(lens->image_distance - wanted) <= 1e-9 * wanted, "another lens at a point of the table");
  }
  constexpr int steps = 16;
  for (int i = -1; i <= steps + 1; ++i) {
    const double zoom = first.zoom + (last.zoom - first.zoom) * i / steps;
    for (const double share : {0.0, 0.3, 1.0}) {
      claim_way_back(*table, {zoom, first.focus + share * (last.focus - first.focus)});
    }
  }
  claim(!table->lens_at({std::nan(""), first.focus}), "a lens at no count");
  return 0;
}
