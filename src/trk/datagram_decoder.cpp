#include "datagram_decoder.h"

#include <algorithm>
#include <utility>

#include "trackmen.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::trk {

void DatagramDecoder::begin(std::string_view datagram, const transport::Sender& sender) noexcept {
  datagram_ = datagram;
  sender_ = sender;
  is_given_ = false;
}

transport::Decoder::Next DatagramDecoder::next(transport::Sample& into, transport::Fault& fault) noexcept {
  if (std::exchange(is_given_, true)) return Next::none;
  if (is_trackmen(datagram_)) {
    const auto params = trackmen_params(datagram_);
    if (!params) {
      fault = params.error();
      return Next::fault;
    }
    into.record = *params;
    into.origin = "binary trackmen";
  } else {
    wire::DecodedForm form;
    wire::Fault why{};
    if (!decode(into.record, form, why)) {
      fault = why;
      return Next::fault;
    }
    into.origin = transport::origin_of(form.form, form.layout_guessed);
  }
  into.has_counter = into.has_lens = true;
  into.encoders = {};
  into.doubt = "";
  into.sample_time.reset();
  into.time_code.reset();
  return Next::sample;
}

bool DatagramDecoder::decode(wire::Record& into, wire::DecodedForm& form, wire::Fault& fault) noexcept {
  if (Entry* known = find(sender_)) {
    known->last_used = ++uses_;
    return wire::decode(datagram_, known->detector, into, form, fault);
  }
  wire::LayoutDetector detector(layout_);
  if (!wire::decode(datagram_, detector, into, form, fault)) return false;
  Entry& entry = place_for_new();
  entry = {sender_, detector, ++uses_};
  recent_ = static_cast<std::size_t>(&entry - entries_.data());
  return true;
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
