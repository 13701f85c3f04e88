#include "datagram_decoder.h"

#include <algorithm>

#include "trk_bridge/transport/sample.h"

namespace trk_bridge::trk {

void DatagramDecoder::begin(std::string_view datagram, const transport::Sender& sender) noexcept {
  decoded_ = decode(datagram, sender);
  given_ = false;
}

transport::Decoder::Next DatagramDecoder::next(transport::Sample& into, transport::Fault& fault) noexcept {
  if (given_) return Next::none;
  given_ = true;
  if (!decoded_) {
    fault = decoded_.error();
    return Next::fault;
  }
  into.record = decoded_->record;
  into.origin = transport::origin_of(decoded_->form, decoded_->layout_guessed);
  into.has_counter = into.has_lens = true;
  into.sample_time.reset();
  into.time_code.reset();
  return Next::sample;
}

tl::expected<wire::Decoded, wire::Fault> DatagramDecoder::decode(std::string_view datagram,
                                                                 const transport::Sender& sender) noexcept {
  if (Entry* known = find(sender)) {
    known->last_used = ++uses_;
    return wire::decode(datagram, known->detector);
  }
  wire::LayoutDetector detector(layout_);
  auto decoded = wire::decode(datagram, detector);
  if (decoded) {
    Entry& entry = place_for_new();
    entry = {sender, detector, ++uses_};
    recent_ = static_cast<std::size_t>(&entry - entries_.data());
  }
  return decoded;
}

DatagramDecoder::Entry* DatagramDecoder::find(const transport::Sender& sender) noexcept {
  if (recent_ < count_ && entries_[recent_].sender == sender) return &entries_[recent_];
  for (std::size_t i = 0; i < count_; ++i) {
    if (entries_[i].sender == sender) {
      recent_ = i;
      return &entries_[i];
    }
  }
  return nullptr;
}

DatagramDecoder::Entry& DatagramDecoder::place_for_new() noexcept {
  if (count_ < capacity) return entries_[count_++];
  return *std::min_element(entries_.begin(), entries_.end(),
                           [](const Entry& a, const Entry& b) { return a.last_used < b.last_used; });
}

}  // namespace trk_bridge::trk
