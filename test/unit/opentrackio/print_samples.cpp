// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Prints the samples of the worked cases, one line of JSON each: in both encodings, all profiles and models, with and
// without times. CBOR is printed as JSON.
#include <iostream>

#include "opentrackio/encoder.h"
#include "worked_cases.h"

#include <nlohmann/json.hpp>

int main() {
  using namespace trk_bridge;
  using namespace trk_bridge::opentrackio;
  int number = 0;
  for (const auto& c : test::worked_cases()) {
    ++number;
    WriterSettings settings;
    settings.source = static_cast<std::uint32_t>(1 + number % 200);
    settings.profile = number % 2 == 0 ? Profile::generic : Profile::unreal;
    settings.model = number % 3 == 0 ? Model::undistorted_to_distorted : Model::distorted_to_undistorted;
    constexpr std::array<double, 5> rates{23.976, 25, 50, 59.94, 119.88};
    const double rate = rates[static_cast<std::size_t>(number) % rates.size()];
    if (number % 4 != 0) settings.rate = rate;
    for (const Encoding encoding : {Encoding::json, Encoding::cbor}) {
      PacketEncoder encoder(settings, encoding, uuid(1, 2));
      encoder.use_time(1'700'000'000'000'000'000 + number, base::TimeCodeWithRate{{23, 59, 58, 11, 2}, rate});
      for (const bool has_static : {true, false}) {
        if ((has_static && !encoder.begin(c.constants)) || !encoder.begin(c.params)) return 1;
        std::string text;
        while (const auto datagram = encoder.next()) text += datagram->substr(header_size);
        const auto sample = encoding == Encoding::json ? nlohmann::json::parse(text) : nlohmann::json::from_cbor(text);
        std::cout << sample.dump() << '\n';
      }
    }
  }
  return 0;
}
