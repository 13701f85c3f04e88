// Binary records whose layout is to be detected.
#pragma once

#include <string_view>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire {

/// Reads one image into `into` and, when it is good, remembers in the `LayoutDetector` what it shows of the sender.
struct LayoutDetectorAccess {
  [[nodiscard]] static bool params(std::string_view image, LayoutDetector& detector, Record& into, DecodedForm& form,
                                   Fault& fault) noexcept;
  [[nodiscard]] static bool constants(std::string_view image, LayoutDetector& detector, Record& into, DecodedForm& form,
                                      Fault& fault) noexcept;

 private:
  /// Reads `into` in this layout and remembers that.
  static bool read(std::string_view image, LayoutDetector& detector, const Layout&, CameraParams& into,
                   DecodedForm& form, Fault& fault) noexcept;
  /// The counter of a 200-byte image, and its abi into `layout`.
  static std::uint64_t counter(std::string_view image, Layout& layout, LayoutDetector& detector) noexcept;
};

/// How well an image of this layout's size reads in it, for who has more than its size and its sender to go by: 0 no
/// program writes this, 1 possible, 2 well. Stricter than the detector: a matrix has to be rigid, and the format mask
/// and the id must not both be beyond what is known.
[[nodiscard]] unsigned params_grade(std::string_view image, Layout) noexcept;
/// The same of constants: 2 has a picture and a chip of likely sides, 1 may have zeros there.
[[nodiscard]] unsigned constants_grade(std::string_view image, Layout) noexcept;

}  // namespace trk_bridge::wire
