// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "datagram_decoder.h"

#include <utility>

#include "trackmen.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::trk {

bool claims(std::string_view datagram) noexcept {
  if (is_trackmen(datagram)) return true;
  wire::LayoutDetector detector;
  wire::Record record;
  wire::DecodedForm form;
  wire::Fault fault{};
  if (wire::decode(datagram, detector, record, form, fault)) return true;
  return fault.reason != wire::Reason::bad_magic && fault.reason != wire::Reason::truncated;
}

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
    into.record = wire::Record(*params);
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
  if (wire::LayoutDetector* known = detectors_.find(sender_)) {
    return wire::decode(datagram_, *known, into, form, fault);
  }
  wire::LayoutDetector detector(layout_);
  if (!wire::decode(datagram_, detector, into, form, fault)) return false;
  detectors_.add(sender_, detector);
  return true;
}

}  // namespace trk_bridge::trk
