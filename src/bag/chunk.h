// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Packs chunks of bags, and unpacks them as far as possible.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trk_bridge::bag {

struct Unpacked {
  std::vector<std::uint8_t> bytes;
  /// Why the bytes are incomplete, as the end of a phrase that begins "the chunk at byte N"; empty: they are complete.
  std::string fault;
};

/// `compression` is the word in the bag: bz2 or lz4; any other is a fault. Returns everything that was packed
/// completely before a cut or a fault, up to 1 GiB, which is more than any recorder puts into one chunk.
Unpacked unpack_chunk(const std::string& compression, std::vector<std::uint8_t>& packed);

/// `compression` is bz2 or lz4.
std::vector<std::uint8_t> pack_chunk(const std::string& compression, std::vector<std::uint8_t>& bytes);

}  // namespace trk_bridge::bag
