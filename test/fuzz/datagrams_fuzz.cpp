// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any datagrams of several senders, in any order, for the decoders of every protocol; what they give, written by the
// encoders and read again.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "codec_claims.h"
#include "exact_copy.h"
#include "freed/decoder.h"
#include "freed/encoder.h"
#include "freed_messages.h"
#include "fuzz.h"
#include "opentrackio/decoder.h"
#include "trk/datagram_decoder.h"
#include "trk/datagram_encoder.h"

namespace {

using namespace trk_bridge;
using test::claim;
using transport::Decoder;
using transport::Sample;
using transport::Sender;

constexpr std::size_t senders = 4;

enum class Protocol : std::uint8_t { trk, trk_given_layout, freed, freed_lenient, opentrackio, opentrackio_any };
constexpr std::size_t protocols = 6;

std::unique_ptr<Decoder> decoder_of(Protocol protocol) {
  static const auto table = test::table_of(
      "points: [{zoom: 0, focal_length: 8}, {zoom: 10000000, focal_length: 80}]\n"
      "constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}\n");
  switch (protocol) {
    case Protocol::trk:
      return std::make_unique<trk::DatagramDecoder>(wire::LayoutChoice{});
    case Protocol::trk_given_layout:
      return std::make_unique<trk::DatagramDecoder>(wire::LayoutChoice{wire::Generation::document, {}, {}});
    case Protocol::freed:
      return std::make_unique<freed::Decoder>(freed::DecoderOptions{});
    case Protocol::freed_lenient:
      return std::make_unique<freed::Decoder>(freed::DecoderOptions{freed::Profile::vizrt, table, true});
    case Protocol::opentrackio:
      return std::make_unique<opentrackio::PacketDecoder>(false, 37);
    case Protocol::opentrackio_any:
      return std::make_unique<opentrackio::PacketDecoder>(true, 37);
  }
  return nullptr;
}

template <typename Record>
void claim_finite(const Record& record) {
  claim(test::all_finite(record), "a number is not finite");
}

void claim_valid(const Sample& sample) {
  claim(!std::string_view(sample.origin).empty(), "a sample without an origin");
  std::visit([](const auto& record) { claim_finite(record); }, sample.record);
  if (!sample.time_code) return;
  const auto code = base::parse_time_code(to_string(sample.time_code->code));
  claim(code && *code == sample.time_code->code, "a time code that is none");
}

/// trk, in every form: the same record is read.
template <typename Record>
void claim_trk_round_trip(const Record& record) {
  constexpr wire::Layout big{wire::Generation::identified, wire::Abi::lp64, wire::ByteOrder::big};
  constexpr wire::Layout identified{wire::Generation::identified, wire::Abi::llp64, wire::ByteOrder::little};
  for (const wire::WireForm& form : {wire::WireForm{}, wire::WireForm{wire::Encoding::binary, big},
                                     wire::WireForm{wire::Encoding::binary, identified}}) {
    if (form.encoding == wire::Encoding::ascii && !test::text_carries(record)) continue;
    trk::DatagramEncoder encoder(form);
    if (!encoder.begin(record)) {
      claim(!encoder.next(), "a datagram of a record that was refused");
      claim(form.layout.abi == wire::Abi::llp64, "a valid record that is refused");
      continue;
    }
    const auto datagram = encoder.next();
    claim(datagram && datagram->size() <= wire::max_datagram, "no datagram");
    trk::DatagramDecoder decoder({form.layout.generation, form.layout.abi, form.layout.byte_order});
    decoder.begin(*datagram, {});
    Sample sample;
    transport::Fault fault;
    claim(decoder.next(sample, fault) == Decoder::Next::sample && sample.record == wire::Record(record),
          "another record than was written");
    claim(!encoder.next(), "two datagrams of one record");
  }
}

/// Free-D rounds; what was rounded once stays.
void claim_freed_round_trip(const wire::CameraParams& params) {
  const freed::EncoderOptions options{freed::Profile::zcam, nullptr, true};
  freed::Encoder first(options), second(options);
  if (!first.begin(params)) {
    claim(!first.next(), "a datagram of parameters that were refused");
    return;
  }
  const auto datagram = first.next();
  claim(datagram && datagram->size() == freed::message_size && !first.next(), "not one message");
  freed::Decoder decoder({freed::Profile::zcam, nullptr, false});
  decoder.begin(*datagram, {});
  Sample sample;
  transport::Fault fault;
  claim(decoder.next(sample, fault) == Decoder::Next::sample, "a message of our own that is refused");
  if (!sample.has_lens) return;
  const auto* const read = std::get_if<wire::CameraParams>(&sample.record);
  claim(read != nullptr && read->id == params.id && second.begin(*read).has_value(), "parameters that are refused");
  claim(second.next() == datagram, "other bytes when written again");
}

void claim_round_trip(const Sample& sample) {
  std::visit([](const auto& record) { claim_trk_round_trip(record); }, sample.record);
  if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) claim_freed_round_trip(*params);
}

bool same(const Sample& a, const Sample& b) {
  return a.record == b.record && std::string_view(a.origin) == b.origin && a.has_counter == b.has_counter &&
         a.has_lens == b.has_lens && a.encoders == b.encoders && std::string_view(a.doubt) == b.doubt;
}

/// Gives all of the datagram. With `alone`, which saw this sender only: both give the same.
void decode(std::string_view datagram, const Sender& sender, Decoder& decoder, Decoder* alone) {
  decoder.begin(datagram, sender);
  if (alone != nullptr) alone->begin(datagram, sender);
  Sample sample, other;
  transport::Fault fault, other_fault;
  for (int results = 0;; ++results) {
    claim(results < 8, "no end");
    const auto next = decoder.next(sample, fault);
    if (alone != nullptr) claim(alone->next(other, other_fault) == next, "another sender counts");
    if (next == Decoder::Next::none) break;
    if (next == Decoder::Next::fault) {
      claim(!describe(fault).empty() && fault.name() != std::string_view("none"), "a fault without a description");
      if (alone != nullptr) claim(fault == other_fault, "another fault because of another sender");
      continue;
    }
    if (alone != nullptr) claim(same(sample, other), "another sample because of another sender");
    claim_valid(sample);
    claim_round_trip(sample);
  }
  claim(decoder.next(sample, fault) == Decoder::Next::none, "more behind the end");
}

/// A packet with the right checksum, which a fuzzer does not come upon.
std::string packet_of(test::Input& input) {
  opentrackio::Packet packet;
  packet.encoding = input.flag() ? opentrackio::Encoding::json : opentrackio::Encoding::cbor;
  packet.is_last = input.flag();
  packet.sequence = input.number<std::uint8_t>();
  packet.offset = input.number<std::uint16_t>();
  packet.payload = input.bytes(input.number<std::uint16_t>() % opentrackio::most_payload);
  opentrackio::PacketBuffer buffer;
  return std::string(opentrackio::write(packet, buffer));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  test::Input input(data, size);
  const auto protocol = static_cast<Protocol>(input.below(protocols));
  const auto together = decoder_of(protocol);
  const bool has_checksum = protocol == Protocol::opentrackio || protocol == Protocol::opentrackio_any;
  // Only trk remembers nothing but what the sender itself has shown.
  const bool is_trk = protocol == Protocol::trk || protocol == Protocol::trk_given_layout;
  std::array<std::unique_ptr<Decoder>, senders> alone;
  while (!input.is_empty()) {
    const std::size_t which = input.below(senders);
    const std::string bytes =
        has_checksum && input.flag() ? packet_of(input) : std::string(input.bytes(input.number<std::uint16_t>()));
    const test::ExactCopy datagram(bytes);
    const Sender sender{transport::SenderKind::ipv4, {127, 0, 0, 1}, static_cast<std::uint32_t>(which)};
    if (is_trk && !alone[which]) alone[which] = decoder_of(protocol);
    decode(datagram.view(), sender, *together, alone[which].get());
  }
  return 0;
}
