// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads binary records and detects their layout.
#pragma once

#include <string_view>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire {

/// Reads one image into `into` and, if it is valid, stores in the `LayoutDetector` what it shows about the sender.
struct LayoutDetectorAccess {
  [[nodiscard]] static bool params(std::string_view image, LayoutDetector& detector, Record& into, DecodedForm& form,
                                   Fault& fault) noexcept;
  [[nodiscard]] static bool constants(std::string_view image, LayoutDetector& detector, Record& into, DecodedForm& form,
                                      Fault& fault) noexcept;

 private:
  /// Reads `into` in this layout and stores the layout.
  static bool read(std::string_view image, LayoutDetector& detector, const Layout&, CameraParams& into,
                   DecodedForm& form, Fault& fault) noexcept;
  /// The counter of a 200-byte image; its abi is written to `layout`.
  static std::uint64_t counter(std::string_view image, Layout& layout, LayoutDetector& detector) noexcept;
};

/// How plausible an image is in this layout, whose size it has: 0 no program writes this, 1 possible, 2 plausible. For
/// callers with more information than size and sender. Stricter than the detector: a matrix must be rigid, and the
/// format mask and the id must not both be unknown.
[[nodiscard]] unsigned params_grade(std::string_view image, Layout) noexcept;
/// The same for constants: with 2, image and chip have plausible sides; with 1, they may be zero.
[[nodiscard]] unsigned constants_grade(std::string_view image, Layout) noexcept;

}  // namespace trk_bridge::wire
