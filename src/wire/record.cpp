#include "trk_bridge/wire/record.h"

#include "fields.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::wire {

namespace {

template <std::size_t n, class T>
bool equal(const std::array<const T*, n>& a, const std::array<const T*, n>& b) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    if (*a[i] != *b[i]) return false;
  }
  return true;
}

}  // namespace

bool operator==(const CameraParams& a, const CameraParams& b) noexcept {
  if (a.id != b.id || a.format != b.format || a.counter != b.counter) return false;
  const bool same_pose = has(a.format, euler) ? equal(euler_of(a), euler_of(b)) : a.matrix == b.matrix;
  return same_pose && equal(lens_of(a), lens_of(b));
}

bool operator==(const CameraConstants& a, const CameraConstants& b) noexcept {
  return a.id == b.id && equal(pixels_of(a), pixels_of(b)) && equal(sizes_of(a), sizes_of(b));
}

}  // namespace trk_bridge::wire
