// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A take that a test writes and plays.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "file/scheme.h"
#include "temporary_directory.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::file {

class PlayFile : public testing::Test {
 protected:
  /// A take whose counters are 1..n.
  SourceSettings take_of(int n) {
    std::string text = "DMC01\n10:20:30:12:1\n1920 1080 14 2 12 4 27 18 27 18\n";
    for (int i = 1; i <= n; ++i) text += "1 1 2 3 4 5 6 50 0 0 0 0 5 8 " + std::to_string(i) + "\n";
    test::write_text(path, text);
    SourceSettings settings;
    settings.path = path;
    return settings;
  }

  test::TemporaryDirectory directory;
  const std::string path = directory / "take.trk";
};

inline bool is_constants(const transport::Reception& r) {
  return std::holds_alternative<wire::CameraConstants>(r.sample.record);
}
inline std::uint64_t counter(const transport::Reception& r) {
  return std::get<wire::CameraParams>(r.sample.record).counter;
}

}  // namespace trk_bridge::file
