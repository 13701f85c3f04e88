// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Time to read and to write one record, compared with other code: ASCII with sscanf and sprintf with the conversions of
// existing programs (doc/wire_formats.md), binary with two copies of the 200 bytes.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "transport/datagram.h"
#include "trk/datagram_decoder.h"
#include "trk/datagram_encoder.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge {
namespace {

using wire::CameraParams;

constexpr std::uint32_t euler = wire::euler | wire::studio_y_up;
constexpr std::uint32_t matrix = wire::studio_y_up;
constexpr std::size_t many = 512;

/// A shot: the camera moves; if it zooms, the lens changes; the iris stays.
CameraParams field_of_shot(std::uint32_t format, bool zooms, std::size_t i) {
  const double t = 0.02 * static_cast<double>(i);
  const double pan = 0.7 * std::sin(0.31 * t), tilt = 0.2 * std::sin(0.53 * t),
               zoom = 1.5 + std::sin(zooms ? 0.17 * t : 1);
  CameraParams p;
  p.format = format;
  if (wire::has(format, wire::euler)) {
    constexpr double degrees = 57.29577951308232;
    p.euler = {2 * std::sin(0.11 * t), -3 + std::cos(0.13 * t),      1.75 + 0.4 * std::sin(0.2 * t),
               degrees * pan,          degrees * (tilt - 0.3 * pan), 0.05 * std::sin(t)};
  } else {
    p.matrix = {std::cos(pan),
                std::sin(pan),
                0,
                0,
                -std::sin(pan) * std::cos(tilt),
                std::cos(pan) * std::cos(tilt),
                std::sin(tilt),
                0,
                std::sin(pan) * std::sin(tilt),
                -std::cos(pan) * std::sin(tilt),
                std::cos(tilt),
                0,
                2 * std::sin(0.11 * t),
                -3 + std::cos(0.13 * t),
                1.75 + 0.4 * std::sin(0.2 * t),
                1};
  }
  p.fov = 12 * zoom;
  p.center_x = 0.0619924 * zoom;
  p.center_y = -0.0549277 / zoom;
  p.k1 = -0.00062933 / zoom;
  p.k2 = 4.265851e-06 / (zoom * zoom);
  p.focdist = 4.5 + std::sin(zooms ? 0.7 * t : 1);
  p.aperture = 4;
  p.counter = 4240746277 + i;
  return p;
}

std::vector<CameraParams> shot(std::uint32_t format, bool zooms = true) {
  std::vector<CameraParams> all;
  for (std::size_t i = 0; i < many; ++i) all.push_back(field_of_shot(format, zooms, i));
  return all;
}

/// ASCII as existing programs print it.
std::size_t field_print(const CameraParams& p, char* to) {
  const wire::Euler& e = p.euler;
  const auto& m = p.matrix;
  const unsigned long counter = p.counter;
  if (wire::has(p.format, wire::euler)) {
    return static_cast<std::size_t>(std::sprintf(to, "%X %g %g %g %g %g %g %g %e %e %e %e %g %g %lu", p.format, e.x,
                                                 e.y, e.z, e.pan, e.tilt, e.roll, p.fov, p.center_x, p.center_y, p.k1,
                                                 p.k2, p.focdist, p.aperture, counter));
  }
  return static_cast<std::size_t>(
      std::sprintf(to, "%X %.7e %.7e %.7e %.7e %.7e %.7e %.7e %.7e %.7e %.7e %.7e %.7e %g %e %e %e %e %g %g %lu",
                   p.format, m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10], m[12], m[13], m[14], p.fov,
                   p.center_x, p.center_y, p.k1, p.k2, p.focdist, p.aperture, counter));
}

/// ASCII as existing programs read it.
bool field_scan(const char* text, CameraParams& p) {
  int skip = 0;
  if (std::sscanf(text, "%x%n", &p.format, &skip) != 1) return false;
  text += skip;
  unsigned long counter = 0;
  bool good = false;
  if (wire::has(p.format, wire::euler)) {
    wire::Euler& e = p.euler;
    good =
        std::sscanf(text, "%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lu", &e.x, &e.y, &e.z, &e.pan, &e.tilt,
                    &e.roll, &p.fov, &p.center_x, &p.center_y, &p.k1, &p.k2, &p.focdist, &p.aperture, &counter) == 14;
  } else {
    auto& m = p.matrix;
    good = std::sscanf(text, "%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lu", &m[0],
                       &m[1], &m[2], &m[4], &m[5], &m[6], &m[8], &m[9], &m[10], &m[12], &m[13], &m[14], &p.fov,
                       &p.center_x, &p.center_y, &p.k1, &p.k2, &p.focdist, &p.aperture, &counter) == 20;
    m[3] = m[7] = m[11] = 0;
    m[15] = 1;
  }
  p.counter = counter;
  return good;
}

wire::WireForm form_of(wire::Encoding encoding) {
  return {encoding, {wire::Generation::identified, wire::Abi::lp64, wire::ByteOrder::little}};
}

/// The digits of a text: 6 to 8 as in existing programs, or all as in ours.
enum class Digits { few, all };

std::string datagram_of(const CameraParams& params, wire::Encoding encoding, Digits digits) {
  if (encoding == wire::Encoding::ascii && digits == Digits::few) {
    char text[wire::max_datagram];
    return std::string("DMC01\0PA", 8) + std::string(text, field_print(params, text)) + '\0';
  }
  wire::Buffer buffer;
  const auto written = wire::encode(params, form_of(encoding), buffer);
  if (!written) throw std::runtime_error(describe(written.error()));
  return std::string(*written);
}

std::vector<std::string> datagrams(std::uint32_t format, wire::Encoding encoding, Digits digits = Digits::all) {
  std::vector<std::string> all;
  for (const CameraParams& params : shot(format)) all.push_back(datagram_of(params, encoding, digits));
  return all;
}

/// Returns one after another, cyclically.
template <class T>
class Ring {
 public:
  explicit Ring(std::vector<T> all) : all_(std::move(all)) {}
  const T& next() noexcept { return all_[i_++ % many]; }

 private:
  std::vector<T> all_;
  std::size_t i_ = 0;
};

/// Decodes a datagram to a sample.
void decode(benchmark::State& state, std::vector<std::string> datagrams, bool with_constants) {
  Ring<std::string> ring(std::move(datagrams));
  trk::DatagramDecoder decoder({});
  transport::Sender sender;
  sender.kind = transport::SenderKind::ipv4;
  transport::Sample sample;
  transport::Fault fault;
  // Our senders repeat constants: they determine the layout of binary records.
  wire::Buffer buffer;
  if (with_constants) {
    decoder.begin(*wire::encode(wire::CameraConstants{}, form_of(wire::Encoding::binary), buffer), sender);
    if (decoder.next(sample, fault) != transport::Decoder::Next::sample) state.SkipWithError(fault.name());
  }
  for (auto _ : state) {
    decoder.begin(ring.next(), sender);
    if (decoder.next(sample, fault) != transport::Decoder::Next::sample) state.SkipWithError(fault.name());
    benchmark::DoNotOptimize(sample);
    if (decoder.next(sample, fault) != transport::Decoder::Next::none) state.SkipWithError("more than one");
  }
}

/// Encodes a record to a datagram.
void encode(benchmark::State& state, const std::vector<CameraParams>& records, wire::Encoding encoding) {
  Ring<CameraParams> ring(records);
  trk::DatagramEncoder encoder(form_of(encoding));
  for (auto _ : state) {
    if (!encoder.begin(ring.next())) state.SkipWithError("not encodable");
    auto datagram = encoder.next();
    benchmark::DoNotOptimize(datagram);
    benchmark::ClobberMemory();
    if (encoder.next()) state.SkipWithError("more than one");
  }
}

void scan(benchmark::State& state, std::vector<std::string> datagrams) {
  Ring<std::string> ring(std::move(datagrams));
  CameraParams params;
  for (auto _ : state) {
    if (!field_scan(ring.next().c_str() + wire::header_size, params)) state.SkipWithError("not readable");
    benchmark::DoNotOptimize(params);
  }
}

void print(benchmark::State& state, const std::vector<CameraParams>& records) {
  Ring<CameraParams> ring(records);
  char text[wire::max_datagram];
  for (auto _ : state) {
    benchmark::DoNotOptimize(field_print(ring.next(), text));
    benchmark::ClobberMemory();
  }
}

void copy_twice(benchmark::State& state) {
  Ring<std::string> ring(datagrams(euler, wire::Encoding::binary));
  std::array<char, 200> a, b;
  for (auto _ : state) {
    std::memcpy(a.data(), ring.next().data() + wire::header_size, a.size());
    benchmark::DoNotOptimize(a);
    std::memcpy(b.data(), a.data(), b.size());
    benchmark::DoNotOptimize(b);
  }
}

void add(const std::string& name, std::uint32_t format) {
  using wire::Encoding;
  const auto run = [](const std::string& what, auto measure, auto... of) {
    benchmark::RegisterBenchmark(what.c_str(), [=](benchmark::State& state) { measure(state, of...); });
  };
  for (const Digits digits : {Digits::few, Digits::all}) {
    const auto texts = datagrams(format, Encoding::ascii, digits);
    const std::string what = "BM_parse_" + name + (digits == Digits::few ? "_field_digits" : "_all_digits");
    run(what + "/ours", decode, texts, true);
    run(what + "/peer", scan, texts);
  }
  for (const bool zooms : {true, false}) {
    const std::string what = "BM_print_" + name + (zooms ? "" : "_without_zoom");
    run(what + "/ours", encode, shot(format, zooms), Encoding::ascii);
    run(what + "/peer", print, shot(format, zooms));
  }
  for (const bool with_constants : {true, false}) {
    const std::string what = "BM_decode_" + name + (with_constants ? "" : "_without_constants");
    run(what + "/ours", decode, datagrams(format, Encoding::binary), with_constants);
    run(what + "/peer", copy_twice);
  }
  run("BM_encode_" + name + "/ours", encode, shot(format), Encoding::binary);
  run("BM_encode_" + name + "/peer", copy_twice);
}

}  // namespace
}  // namespace trk_bridge

int main(int argc, char** argv) {
  trk_bridge::add("euler", trk_bridge::euler);
  trk_bridge::add("matrix", trk_bridge::matrix);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
