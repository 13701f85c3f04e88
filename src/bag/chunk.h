// Compressed chunks of bags, packed, and unpacked as far as they go.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trk_bridge::bag {

struct Unpacked {
  std::vector<std::uint8_t> bytes;
  std::string fault;  ///< why there is no more of them; empty when all is there. Reads behind "the chunk at byte N".
};

/// `compression` is a bag's word: bz2 or lz4; any other is a fault. What was packed whole before a cut or a fault is
/// given, up to the 1 GiB that no recorder puts into one chunk.
Unpacked unpack_chunk(const std::string& compression, std::vector<std::uint8_t>& packed);

/// `compression` is bz2 or lz4.
std::vector<std::uint8_t> pack_chunk(const std::string& compression, std::vector<std::uint8_t>& bytes);

}  // namespace trk_bridge::bag
