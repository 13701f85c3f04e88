// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Builds and parses packets, samples and their members, independently of the code under test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "opentrackio/decoder.h"
#include "opentrackio/encoder.h"
#include "opentrackio/packet.h"
#include "worked_cases.h"

namespace trk_bridge::test {

using Json = nlohmann::ordered_json;

inline const std::string source_id = "urn:uuid:5e1f0a6c-0000-8000-8000-000000000001";

/// A packet with its checksum as the standard describes it: Fletcher's two sums modulo 256.
inline std::string packet_of(std::string_view payload, opentrackio::Encoding encoding = opentrackio::Encoding::json,
                             unsigned sequence = 0, unsigned offset = 0, bool is_last = true) {
  const auto push = [](std::string& to, unsigned value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) to.push_back(static_cast<char>(value >> shift & 0xFFU));
  };
  std::string packet = "OTrk";
  push(packet, 0, 1);
  push(packet, static_cast<unsigned>(encoding), 1);
  push(packet, sequence, 2);
  push(packet, offset, 4);
  push(packet, static_cast<unsigned>(payload.size()) + (is_last ? 0x8000U : 0U), 2);
  unsigned first = 0, second = 0;
  for (const char c : packet + std::string(payload)) {
    first = (first + static_cast<unsigned char>(c)) % 256;
    second = (second + first) % 256;
  }
  push(packet, second * 256 + first, 2);
  return packet + std::string(payload);
}

/// Everything that the decoder returns for a datagram.
struct Given {
  std::vector<transport::Sample> samples;
  std::vector<std::string> faults;  ///< described

  const wire::CameraParams& params() const {
    for (const auto& sample : samples) {
      if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) return *params;
    }
    throw std::runtime_error("no parameters: " + (faults.empty() ? std::string("nothing") : faults.front()));
  }
  const wire::CameraConstants& constants() const {
    for (const auto& sample : samples) {
      if (const auto* constants = std::get_if<wire::CameraConstants>(&sample.record)) return *constants;
    }
    throw std::runtime_error("no constants: " + (faults.empty() ? std::string("nothing") : faults.front()));
  }
};

inline Given given(opentrackio::PacketDecoder& decoder, std::string_view datagram, std::uint32_t port = 1) {
  Given given;
  decoder.begin(datagram, {transport::SenderKind::ipv4, {192, 0, 2, 7}, port});
  for (;;) {
    transport::Sample sample;
    transport::Fault fault;
    switch (decoder.next(sample, fault)) {
      case transport::Decoder::Next::sample:
        given.samples.push_back(sample);
        break;
      case transport::Decoder::Next::fault:
        given.faults.push_back(describe(fault));
        break;
      case transport::Decoder::Next::none:
        return given;
    }
  }
}

/// The datagrams of one record.
template <typename Record>
std::vector<std::string> datagrams_of(opentrackio::PacketEncoder& encoder, const Record& record) {
  const auto begun = encoder.begin(record);
  EXPECT_TRUE(begun) << describe(begun.error());
  std::vector<std::string> datagrams;
  while (const auto datagram = encoder.next()) datagrams.emplace_back(*datagram);
  return datagrams;
}

/// The content of the datagrams for a receiver, CBOR as JSON.
inline Json sample_in(const std::vector<std::string>& datagrams) {
  std::string text;
  for (const auto& datagram : datagrams) text += datagram.substr(16);
  return datagrams.front()[5] == 1 ? Json::parse(text) : Json::from_cbor(text);
}

/// A sample with all trk values, static and dynamic.
inline Json full_sample() {
  return Json::parse(R"({
    "static": {"camera": {"activeSensorPhysicalDimensions": {"height": 5.4, "width": 9.6},
                          "activeSensorResolution": {"height": 1080, "width": 1920}, "label": "B"}},
    "protocol": {"name": "OpenTrackIO", "version": [1, 0, 1]},
    "sourceNumber": 7,
    "timing": {"mode": "internal", "sequenceNumber": 65535, "sampleRate": {"num": 50, "denom": 1},
               "sampleTimestamp": {"seconds": 1700000037, "nanoseconds": 250000000},
               "timecode": {"hours": 10, "minutes": 20, "seconds": 30, "frames": 12,
                            "frameRate": {"num": 25, "denom": 1}, "subFrame": 1}},
    "lens": {"pinholeFocalLength": 24.5, "focusDistance": 3.5, "fStop": 2.8,
             "projectionOffset": {"x": 0.25, "y": -0.125},
             "distortion": [{"radial": [0.001, 0, -0.00002, 0, 0, 0]}]},
    "transforms": [{"translation": {"x": 1, "y": 2.5, "z": -3}, "rotation": {"pan": 190, "tilt": -10, "roll": 0.5}}]
  })");
}

}  // namespace trk_bridge::test
