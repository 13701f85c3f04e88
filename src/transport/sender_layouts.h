// What is known of the layout of each sender on one port.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/transport/sender.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::transport {

/// Decodes datagrams with what their sender has told so far. Remembers the senders of good records only; past
/// `capacity` the one that was silent longest gives way. Not synchronised, never allocates.
class SenderLayouts {
 public:
  static constexpr std::size_t capacity = 64;

  /// `said` holds for every sender.
  explicit SenderLayouts(const wire::LayoutChoice& said) : said_(said) {}

  [[nodiscard]] tl::expected<wire::Decoded, wire::Fault> decode(std::string_view datagram,
                                                                const Sender& sender) noexcept;

 private:
  struct Entry {
    Sender sender;
    wire::LayoutDetector detector;
    std::uint64_t last_used = 0;
  };

  Entry* find(const Sender& sender) noexcept;
  Entry& place_for_new() noexcept;

  wire::LayoutChoice said_;
  std::array<Entry, capacity> entries_{};
  std::size_t count_ = 0;
  std::size_t recent_ = 0;  // most datagrams come from the sender of the one before
  std::uint64_t uses_ = 0;
};

}  // namespace trk_bridge::transport
