// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "decoder.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace trk_bridge::opentrackio {
namespace {

const char* origin_of(Encoding encoding, Lost lost) noexcept {
  const bool is_json = encoding == Encoding::json;
  switch (lost) {
    case Lost::nothing:
      return is_json ? "OpenTrackIO JSON" : "OpenTrackIO CBOR";
    case Lost::tangential:
      return is_json ? "OpenTrackIO JSON, tangential distortion ignored"
                     : "OpenTrackIO CBOR, tangential distortion ignored";
    case Lost::distortion_offset:
      return is_json ? "OpenTrackIO JSON, distortionOffset ignored" : "OpenTrackIO CBOR, distortionOffset ignored";
    case Lost::scale:
      return is_json ? "OpenTrackIO JSON, scale ignored" : "OpenTrackIO CBOR, scale ignored";
    case Lost::resolution:
      return is_json ? "OpenTrackIO JSON, no activeSensorResolution: no constants"
                     : "OpenTrackIO CBOR, no activeSensorResolution: no constants";
  }
  return "OpenTrackIO";
}

}  // namespace

bool PacketDecoder::is_copy(std::string_view datagram) noexcept {
  const std::size_t hash = std::hash<std::string_view>{}(datagram);
  const auto known = std::find_if(seen_.begin(), seen_.end(),
                                  [&](const Seen& seen) { return seen.hash == hash && seen.size == datagram.size(); });
  if (known != seen_.end()) return ++known->copies <= most_copies;
  seen_[next_seen_] = {hash, datagram.size(), 0};
  next_seen_ = (next_seen_ + 1) % window;
  return false;
}

/// The sample that is complete with this packet, if any.
std::optional<std::string_view> PacketDecoder::assembled(const Packet& packet,
                                                         const transport::Sender& sender) noexcept {
  Assembly* assembly = assemblies_.find(sender);
  if (assembly == nullptr) {
    if (packet.offset == 0 && packet.is_last) return packet.payload;
    assembly = &assemblies_.add(sender, {});
  }
  std::optional<Reason> lost;
  const auto text = assembly->add(packet, lost);
  if (lost) fault_ = fault_of(*lost);
  return text;
}

void PacketDecoder::begin(std::string_view datagram, const transport::Sender& sender) noexcept {
  fault_.reset();
  records_ = {};
  const auto packet = packet_of(datagram);
  if (!packet) {
    fault_ = fault_of(packet.error());
    return;
  }
  if (is_copy(datagram)) return;
  const auto text = assembled(*packet, sender);
  if (!text) return;
  encoding_ = packet->encoding;
  if (const auto fault = read(*text, encoding_, sample_)) {
    fault_ = fault;
    return;
  }
  auto records = reader_.read(sample_);
  if (records) {
    records_ = *records;
  } else {
    fault_ = records.error();
  }
}

transport::Decoder::Next PacketDecoder::next(transport::Sample& into, transport::Fault& fault) noexcept {
  if (fault_) {
    fault = *fault_;
    fault_.reset();
    return Next::fault;
  }
  if (!records_.constants && !records_.params) {
    if (!records_.fault) return Next::none;
    fault = *records_.fault;
    records_.fault.reset();
    return Next::fault;
  }
  into.origin = origin_of(encoding_, records_.lost);
  into.sample_time = records_.sample_time;
  into.time_code = records_.time_code;
  into.has_counter = records_.has_counter;
  into.has_lens = true;
  if (records_.constants) {
    into.record = wire::Record(*records_.constants);
    records_.constants.reset();
    return Next::sample;
  }
  into.has_lens = records_.has_lens;
  into.record = wire::Record(*records_.params);
  records_.params.reset();
  return Next::sample;
}

}  // namespace trk_bridge::opentrackio
