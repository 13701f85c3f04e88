#include "sender_layouts.h"

#include <algorithm>

namespace trk_bridge::transport {

tl::expected<wire::Decoded, wire::Fault> SenderLayouts::decode(std::string_view datagram,
                                                               const Sender& sender) noexcept {
  if (Entry* known = find(sender)) {
    known->last_used = ++uses_;
    return wire::decode(datagram, known->detector);
  }
  wire::LayoutDetector detector(said_);
  auto decoded = wire::decode(datagram, detector);
  if (decoded) {
    Entry& entry = place_for_new();
    entry = {sender, detector, ++uses_};
    recent_ = static_cast<std::size_t>(&entry - entries_.data());
  }
  return decoded;
}

SenderLayouts::Entry* SenderLayouts::find(const Sender& sender) noexcept {
  if (recent_ < count_ && entries_[recent_].sender == sender) return &entries_[recent_];
  for (std::size_t i = 0; i < count_; ++i) {
    if (entries_[i].sender == sender) {
      recent_ = i;
      return &entries_[i];
    }
  }
  return nullptr;
}

SenderLayouts::Entry& SenderLayouts::place_for_new() noexcept {
  if (count_ < capacity) return entries_[count_++];
  return *std::min_element(entries_.begin(), entries_.end(),
                           [](const Entry& a, const Entry& b) { return a.last_used < b.last_used; });
}

}  // namespace trk_bridge::transport
