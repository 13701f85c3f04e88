// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Records in the document's structures, and invalid handles.
#pragma once

#include <array>
#include <string>

#include "trk_struct.h"

namespace trk_bridge::test {

inline trkCameraParams params_in_c(unsigned long counter) {
  trkCameraParams p{};
  p.format = trkEuler;
  p.t.e = {1, 2, 3, 4, 5, 6};
  p.fov = 7;
  p.counter = counter;
  return p;
}

inline const trkCameraConstants constants_in_c = [] {
  trkCameraConstants c{};
  trkStringToConstants("720 576 10 10 0 0 6.4 4.8 6.5 4.9", &c);
  return c;
}();

/// The text of a record, which is exact: two records are equal if their texts are. Bytes cannot be compared, because
/// the structures have padding.
inline std::string text_of(const trkCameraParams& params) {
  std::array<char, trkStringSize> text{};
  trkParamsToString(&params, text.data());
  return text.data();
}
inline std::string text_of(const trkCameraConstants& constants) {
  std::array<char, trkStringSize> text{};
  trkConstantsToString(&constants, text.data());
  return text.data();
}

inline const trkHandle no_handles[] = {nullptr, reinterpret_cast<trkHandle>(1), reinterpret_cast<trkHandle>(-1),
                                       reinterpret_cast<trkHandle>(0x74726B01)};

}  // namespace trk_bridge::test
