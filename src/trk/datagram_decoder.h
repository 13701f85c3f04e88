// trk's datagrams to samples.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "transport/datagram.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::trk {

/// Decodes with what each sender's records have shown of its layout so far. Remembers the senders of good records only;
/// past `capacity` the one that was silent longest gives way. TrackMen's packets are told by their magic.
class DatagramDecoder final : public transport::Decoder {
 public:
  static constexpr std::size_t capacity = 64;

  /// `layout` holds for every sender.
  explicit DatagramDecoder(const wire::LayoutChoice& layout) : layout_(layout) {}

  void begin(std::string_view datagram, const transport::Sender&) noexcept override;
  Next next(transport::Sample& into, transport::Fault& fault) noexcept override;

 private:
  struct Entry {
    transport::Sender sender;
    wire::LayoutDetector detector;
    std::uint64_t last_used = 0;
  };

  bool decode(wire::Record& into, wire::DecodedForm& form, wire::Fault& fault) noexcept;
  Entry* find(const transport::Sender& sender) noexcept;
  Entry& place_for_new() noexcept;

  wire::LayoutChoice layout_;
  std::string_view datagram_;
  transport::Sender sender_;  // of the datagram
  bool is_given_ = true;      // next() gave what it has
  std::array<Entry, capacity> entries_{};
  std::size_t count_ = 0;
  std::size_t recent_ = 0;  // most datagrams come from the sender of the one before
  std::uint64_t uses_ = 0;
};

}  // namespace trk_bridge::trk
