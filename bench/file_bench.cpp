// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Plays a take as fast as possible, compared with a plain loop over its lines with fgets and sscanf.
#include <benchmark/benchmark.h>

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <unistd.h>

#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge {
namespace {

/// A take of a moving camera, with six digits as trackers write them.
class Take {
 public:
  static constexpr std::int64_t fields = 200'000;

  Take() {
    const auto sink = endpoints::open_sink("file:" + path_ + "?overwrite=1");
    wire::CameraConstants constants;
    constants.image_width = 1920;
    constants.image_height = 1080;
    constants.chip_width = constants.fake_chip_width = 9.59;
    constants.chip_height = constants.fake_chip_height = 5.39;
    good_ = sink->write(constants).has_value();
    for (std::int64_t i = 0; i < fields; ++i) {
      const auto rounded = [i](double value, double digits) {
        return std::round((value + std::sin(static_cast<double>(i) / 50 + value)) * digits) / digits;
      };
      wire::CameraParams params;
      params.format = wire::euler;
      params.euler = {rounded(1, 1e5), rounded(-4, 1e5), rounded(2, 1e5), rounded(158, 1e3), rounded(-12, 1e4), 0};
      params.fov = rounded(53, 1e4);
      params.k1 = 0.0501;
      params.k2 = -0.00012;
      params.focdist = rounded(16, 1e4);
      params.aperture = 8;
      params.counter = static_cast<std::uint64_t>(1000 + i);
      good_ = good_ && sink->write(params);
    }
    good_ = good_ && sink->close();
  }
  ~Take() { std::filesystem::remove(path_); }
  Take(const Take&) = delete;
  Take& operator=(const Take&) = delete;

  bool good() const { return good_; }
  const std::string& path() const { return path_; }

 private:
  const std::string path_ =
      (std::filesystem::temp_directory_path() / ("trk_bridge_bench." + std::to_string(::getpid()) + ".trk")).string();
  bool good_ = false;
};

const Take& take() {
  static const Take made;
  return made;
}

void end(benchmark::State& state, std::int64_t fields) {
  if (fields != Take::fields) state.SkipWithError("not every field was read");
  state.SetItemsProcessed(state.iterations() * Take::fields);
}

void play_a_take(benchmark::State& state) {
  if (!take().good()) return state.SkipWithError("no take could be written");
  std::int64_t fields = 0;
  for (auto _ : state) {
    const auto source = endpoints::open_source("file:" + take().path() + "?speed=0", 50);
    transport::Reception reception;
    fields = 0;
    while (source->receive(reception, std::chrono::nanoseconds(-1)) == transport::Event::sample) {
      fields += std::holds_alternative<wire::CameraParams>(reception.sample.record) ? 1 : 0;
    }
  }
  end(state, fields);
}
BENCHMARK(play_a_take)->Name("BM_PlayATake/ours")->Unit(benchmark::kMillisecond);

/// Opens the file in every iteration, like the source.
std::int64_t fields_by_sscanf(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "r"), &std::fclose);
  std::int64_t fields = 0;
  char line[wire::max_datagram];
  while (file && std::fgets(line, sizeof line, file.get()) != nullptr) {
    wire::CameraParams p;
    auto& e = p.euler;
    const int read = std::sscanf(line, "%" SCNx32 " %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %" SCNu64,
                                 &p.format, &e.x, &e.y, &e.z, &e.pan, &e.tilt, &e.roll, &p.fov, &p.center_x,
                                 &p.center_y, &p.k1, &p.k2, &p.focdist, &p.aperture, &p.counter);
    fields += read == 15 ? 1 : 0;
    benchmark::DoNotOptimize(p);
  }
  return fields;
}

void read_by_sscanf(benchmark::State& state) {
  if (!take().good()) return state.SkipWithError("no take could be written");
  std::int64_t fields = 0;
  for (auto _ : state) fields = fields_by_sscanf(take().path());
  end(state, fields);
}
BENCHMARK(read_by_sscanf)->Name("BM_PlayATake/peer")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trk_bridge

BENCHMARK_MAIN();
