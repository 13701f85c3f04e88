// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Records as bytes, for comparing them.
#pragma once

#include <string>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::test {

/// The bytes of a record: they are equal if all its numbers are equal bit for bit.
template <typename RecordType>
std::string bits(const RecordType& record) {
  wire::Buffer buffer;
  return std::string(wire::to_image(record, {wire::Generation::identified, wire::Abi::lp64, {}}, buffer).value());
}

}  // namespace trk_bridge::test
