// trk's datagrams to samples.
#pragma once

#include <cstddef>
#include <string_view>

#include "transport/datagram.h"
#include "transport/per_sender.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::trk {

/// Whether a datagram begins as trk or as TrackMen's packet, whatever follows.
bool claims(std::string_view datagram) noexcept;

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
  bool decode(wire::Record& into, wire::DecodedForm& form, wire::Fault& fault) noexcept;

  wire::LayoutChoice layout_;
  std::string_view datagram_;
  transport::Sender sender_;  // of the datagram
  bool is_given_ = true;      // next() gave what it has
  transport::PerSender<wire::LayoutDetector, capacity> detectors_;
};

}  // namespace trk_bridge::trk
