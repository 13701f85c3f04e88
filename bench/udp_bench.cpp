// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The time of a datagram from a sink to a source over the loopback interface.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge {
namespace {

using endpoints::open_sink;
using endpoints::open_source;
using transport::Event;
using transport::Reception;
using transport::Source;

wire::CameraParams euler_params() {
  wire::CameraParams params;
  params.id = 1;
  params.format = wire::euler;
  params.euler = {1.2345678901, -2.5, 1.75, 179.99999, -5.125, 0.25};
  params.fov = 42.123456789;
  params.k1 = -0.00123456789;
  params.focdist = 4.5;
  return params;
}

std::string place_of(const Source& source) {
  const std::string name = source.name(), before = "udp port ";
  return "udp://127.0.0.1:" + std::to_string(std::stoi(name.substr(before.size())));
}

const char* options(const benchmark::State& state) { return state.range(0) == 0 ? "" : "?binary=1"; }

/// Writes one set and reads it at once: the cost of every sample.
void BM_WriteAndReceive(benchmark::State& state) {
  const auto source = open_source("udp://127.0.0.1:0");
  const auto sink = open_sink(place_of(*source) + options(state));
  auto params = euler_params();
  Reception reception;
  for (auto _ : state) {
    ++params.counter;
    if (!sink->write(params) || source->receive(reception, std::chrono::nanoseconds(-1)) != Event::sample) {
      state.SkipWithError("a datagram did not arrive");
      break;
    }
    benchmark::DoNotOptimize(reception.sample.record);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_WriteAndReceive)->ArgName("binary")->Arg(0)->Arg(1);

/// Reads a queue of datagrams in batches; writing them is not timed.
void BM_ReceiveQueued(benchmark::State& state) {
  constexpr int queued = 128;
  const auto source = open_source("udp://127.0.0.1:0");
  const auto sink = open_sink(place_of(*source) + options(state));
  auto params = euler_params();
  Reception reception;
  for (auto _ : state) {
    state.PauseTiming();
    for (int i = 0; i < queued; ++i) {
      ++params.counter;
      if (!sink->write(params)) state.SkipWithError("a datagram was not sent");
    }
    state.ResumeTiming();
    for (int i = 0; i < queued; ++i) {
      if (source->receive(reception, std::chrono::seconds(1)) != Event::sample) {
        state.SkipWithError("a datagram did not arrive");
        break;
      }
      benchmark::DoNotOptimize(reception.sample.record);
    }
  }
  state.SetItemsProcessed(state.iterations() * queued);
}
BENCHMARK(BM_ReceiveQueued)->ArgName("binary")->Arg(0)->Arg(1);

/// Only writing: encoding and system call.
void BM_Write(benchmark::State& state) {
  const auto source = open_source("udp://127.0.0.1:0");
  const auto sink = open_sink(place_of(*source) + options(state));
  auto params = euler_params();
  for (auto _ : state) {
    ++params.counter;
    if (!sink->write(params)) state.SkipWithError("a datagram was not sent");
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_Write)->ArgName("binary")->Arg(0)->Arg(1);

}  // namespace
}  // namespace trk_bridge

BENCHMARK_MAIN();
