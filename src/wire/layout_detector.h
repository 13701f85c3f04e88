// Binary records of a sender whose layout is to be detected.
#pragma once

#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire {

/// Reads one image and, when it is good, remembers in the `LayoutDetector` what it shows of the sender.
struct LayoutDetectorAccess {
  [[nodiscard]] static tl::expected<Decoded, Fault> params(std::string_view image, LayoutDetector& detector) noexcept;
  [[nodiscard]] static tl::expected<Decoded, Fault> constants(std::string_view image,
                                                              LayoutDetector& detector) noexcept;

 private:
  /// The counter of a 200-byte image, and its abi into `layout`.
  static std::uint64_t counter(std::string_view image, Layout& layout, LayoutDetector& detector) noexcept;
};

}  // namespace trk_bridge::wire
