// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a packet and as a sample: JSON where they begin with a brace, CBOR else. What is read can be written,
// and is the same again.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "fuzz.h"
#include "opentrackio/decoder.h"
#include "opentrackio/encoder.h"

namespace {

using namespace trk_bridge;
using namespace trk_bridge::opentrackio;

/// What comes of all datagrams; their faults do not count.
Records records_of(PacketEncoder& encoder, const wire::CameraParams& params) {
  Records records;
  PacketDecoder decoder(false, 37);
  if (!encoder.begin(params)) return records;
  while (const auto datagram = encoder.next()) {
    test::claim(datagram->size() <= header_size + most_payload, "a packet that is too long");
    decoder.begin(*datagram, {});
    transport::Sample sample;
    transport::Fault fault;
    for (auto next = decoder.next(sample, fault); next != transport::Decoder::Next::none;
         next = decoder.next(sample, fault)) {
      test::claim(next == transport::Decoder::Next::sample, "a fault of what was written");
      if (const auto* constants = std::get_if<wire::CameraConstants>(&sample.record)) records.constants = *constants;
      if (const auto* read = std::get_if<wire::CameraParams>(&sample.record)) records.params = *read;
    }
  }
  test::claim(records.params == params, "other parameters than were written");
  return records;
}

void claim_round_trip(const Records& records) {
  if (!records.params) return;
  WriterSettings settings;
  settings.source = 1;
  for (const Encoding encoding : {Encoding::json, Encoding::cbor}) {
    PacketEncoder encoder(settings, encoding, uuid(1, 2));
    const bool has_constants =
        records.constants && records.constants->id == records.params->id && encoder.begin(*records.constants);
    const Records again = records_of(encoder, *records.params);
    if (again.params && has_constants)
      test::claim(again.constants == records.constants, "other constants than were written");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  PacketDecoder decoder(true, 37);
  decoder.begin(bytes, {});
  transport::Sample ignored;
  transport::Fault fault;
  while (decoder.next(ignored, fault) != transport::Decoder::Next::none) {
  }
  const Encoding encoding = !bytes.empty() && bytes.front() == '{' ? Encoding::json : Encoding::cbor;
  Sample sample;
  if (read(bytes, encoding, sample)) return 0;
  RecordsReader reader(true, 37);
  if (const auto records = reader.read(sample)) claim_round_trip(*records);
  return 0;
}
