// Binary records of a sender whose layout is to be found out.
#pragma once

#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire {

/// The hands of `LayoutSense`: each reads one image and, when it is good, remembers what it told of the sender.
struct LayoutSenseAccess {
  [[nodiscard]] static tl::expected<Decoded, Fault> params(std::string_view image, LayoutSense& sense) noexcept;
  [[nodiscard]] static tl::expected<Decoded, Fault> constants(std::string_view image, LayoutSense& sense) noexcept;

 private:
  /// The counter of a 200-byte image, with the abi that it tells put into `layout`.
  static std::uint64_t counter(std::string_view image, Layout& layout, LayoutSense& sense) noexcept;
};

}  // namespace trk_bridge::wire
