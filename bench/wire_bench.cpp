// Time to read and to write one record.
#include <benchmark/benchmark.h>

#include <stdexcept>
#include <string>

#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::wire {
namespace {

CameraParams sample(std::uint32_t format) {
  CameraParams p;
  p.id = 1;
  p.format = format;
  p.euler = {-2.3899808692593005, 19.819106827943756, 2.815090112037268,
             6.71814020049942,    15.675059833006529, 111.77870286752176};
  p.matrix = {0.8, 0.6, 0, 0, -0.6, 0.8, 0, 0, 0, 0, 1, 0, -11.120743747916517, 1.358512094614523, 1.7246312086932999,
              1};
  p.fov = 18.321989392933812;
  p.center_x = 0.06199242429905322;
  p.center_y = 0.054927725532342375;
  p.k1 = -0.0006293334524622769;
  p.k2 = 4.265851678489512e-06;
  p.focdist = 29.3234281531595;
  p.aperture = 21.639951728912713;
  p.counter = 4240746277;
  return p;
}

WireForm form_of(bool ascii) {
  return {ascii ? Encoding::ascii : Encoding::binary, {Generation::identified, Abi::lp64, ByteOrder::little}};
}

/// Arguments: ASCII or binary, format mask.
void write_params(benchmark::State& state) {
  const WireForm form = form_of(state.range(0) != 0);
  const CameraParams params = sample(static_cast<std::uint32_t>(state.range(1)));
  Buffer buffer;
  for (auto _ : state) {
    auto written = encode(params, form, buffer);
    if (!written) state.SkipWithError(describe(written.error()).c_str());
    benchmark::DoNotOptimize(written);
  }
  state.SetItemsProcessed(state.iterations());
}

void read_params(benchmark::State& state, const LayoutChoice& given) {
  Buffer buffer;
  const auto written = encode(sample(static_cast<std::uint32_t>(state.range(1))), form_of(state.range(0) != 0), buffer);
  if (!written) throw std::runtime_error(describe(written.error()));
  LayoutDetector detector(given);
  for (auto _ : state) {
    auto read = decode(*written, detector);
    if (!read) state.SkipWithError(describe(read.error()).c_str());
    benchmark::DoNotOptimize(read);
  }
  state.SetItemsProcessed(state.iterations());
}

void read_layout_detected(benchmark::State& state) { read_params(state, {}); }
void read_layout_given(benchmark::State& state) {
  read_params(state, {Generation::identified, Abi::lp64, ByteOrder::little});
}

void ascii_and_binary(benchmark::internal::Benchmark* b) {
  b->ArgNames({"ascii", "format"});
  for (const int ascii : {0, 1}) {
    for (const int format : {0x012, 0x011}) b->Args({ascii, format});
  }
}

BENCHMARK(read_layout_detected)->Apply(ascii_and_binary);
BENCHMARK(read_layout_given)->ArgNames({"ascii", "format"})->Args({0, 0x012})->Args({0, 0x011});
BENCHMARK(write_params)->Apply(ascii_and_binary);

}  // namespace
}  // namespace trk_bridge::wire

BENCHMARK_MAIN();
