// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The index at the end of a bag: its connections, and the positions of its chunks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "reader.h"
#include "records.h"

namespace trk_bridge::bag {

/// Throws BagError if the file is not a bag of format 2.0.
void check_magic(Bytes&);
/// Throws BagError for the header of an encrypted bag.
void check_encryption(const Record& file_header);
/// None if the record is malformed.
std::optional<Connection> connection_of(Bytes&, const Record&);

/// A time of a record: seconds in the upper half, nanoseconds in the lower half, so that times can be compared. None if
/// there is none.
std::optional<std::uint64_t> time_in(const HeaderFields&, const std::string& name);

struct Chunk {
  std::uint64_t place = 0;                                      ///< of its record
  std::uint64_t begin = 0;                                      ///< the earliest time of its messages
  std::vector<std::pair<std::uint32_t, std::uint32_t>> counts;  ///< number of messages by connection
};

struct Index {
  std::vector<Connection> connections;
  std::vector<Chunk> chunks;
};

/// The error is the reason why it cannot be read. Throws BagError like the functions above.
tl::expected<Index, std::string> read_index(Bytes& file);

}  // namespace trk_bridge::bag
