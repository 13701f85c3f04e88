// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads and writes a sample of OpenTrackIO in both encodings. Reading a sample must take less than 20 us.
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "opentrackio/decoder.h"
#include "opentrackio/encoder.h"

namespace {

using namespace trk_bridge;
using namespace trk_bridge::opentrackio;

wire::CameraParams params() {
  wire::CameraParams p;
  p.id = 7;
  p.format = wire::euler;
  p.euler = {1.2345678901234, -2.3456789012345, 1.7501234567891, 30.123456789012, -5.1234567890123, 0.25123456789};
  p.fov = 24.567890123456;
  p.center_x = 0.0123456789;
  p.center_y = -0.0234567891;
  p.k1 = 0.00123456789;
  p.k2 = -0.0000123456789;
  p.focdist = 4.5678901234;
  p.aperture = 2.8;
  return p;
}

WriterSettings settings() {
  WriterSettings settings;
  settings.rate = 50;
  return settings;
}

/// A time stamp and a time code.
void use_time(PacketEncoder& encoder) {
  encoder.use_time(1'700'000'000'123'456'789, base::TimeCodeWithRate{{10, 20, 30, 12, 2}, 50});
}

/// Decodes dynamic samples, all different.
void decode(benchmark::State& state, Encoding encoding) {
  PacketEncoder encoder(settings(), encoding, uuid(1, 2));
  use_time(encoder);
  std::vector<std::string> datagrams;
  wire::CameraParams p = params();
  for (p.counter = 0; p.counter < 512; ++p.counter) {
    p.euler.pan += 0.0123456789;
    if (!encoder.begin(p)) return state.SkipWithError("not encoded");
    while (const auto datagram = encoder.next()) datagrams.emplace_back(*datagram);
  }
  PacketDecoder decoder(false, 37);
  transport::Sample sample;
  transport::Fault fault;
  std::size_t i = 0, samples = 0;
  for (auto _ : state) {
    decoder.begin(datagrams[i++ % datagrams.size()], {});
    while (decoder.next(sample, fault) == transport::Decoder::Next::sample) ++samples;
  }
  if (samples != i) state.SkipWithError("not decoded");
  state.counters["bytes"] = static_cast<double>(datagrams.front().size());
}

void encode(benchmark::State& state, Encoding encoding) {
  PacketEncoder encoder(settings(), encoding, uuid(1, 2));
  use_time(encoder);
  wire::CameraParams p = params();
  for (auto _ : state) {
    ++p.counter;
    if (!encoder.begin(p)) return state.SkipWithError("not encoded");
    while (const auto datagram = encoder.next()) benchmark::DoNotOptimize(datagram->data());
  }
}

BENCHMARK_CAPTURE(decode, json, Encoding::json);
BENCHMARK_CAPTURE(decode, cbor, Encoding::cbor);
BENCHMARK_CAPTURE(encode, json, Encoding::json);
BENCHMARK_CAPTURE(encode, cbor, Encoding::cbor);

}  // namespace

BENCHMARK_MAIN();
