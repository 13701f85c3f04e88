// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Why bytes are not a record, or a record cannot be written.
#pragma once

#include <cstdint>
#include <string>

namespace trk_bridge::wire {

/// What is wrong with received bytes or with a record to be written.
enum class Reason : std::uint8_t {
  too_long,         ///< more than max_datagram bytes
  truncated,        ///< shorter than its header, or ended before its last field
  bad_magic,        ///< does not begin with DMC01 and NUL
  bad_type,         ///< neither P nor C
  bad_encoding,     ///< neither A nor B
  not_a_number,     ///< field N is not a number
  out_of_range,     ///< field N does not fit its type
  not_finite,       ///< field N is NaN or infinite
  trailing_text,    ///< more than white space after the last field
  wrong_size,       ///< no known layout has a binary record of this size
  layout_mismatch,  ///< the size does not match the layout given by the user
  no_valid_layout,  ///< right size, but no layout gives a valid record
};

/// A reason and, if it refers to one field, its number: `field` is the 1-based position in the ASCII order, with the
/// format word (or imageWidth) as field 1 and the id as field 0. Binary records use the same numbers; the bottom row of
/// a binary matrix, which text does not have, uses those of the row above it. `field` is valid only with `about_field`.
/// Cheap to copy; never allocates.
struct Fault {
  Reason reason;
  std::uint8_t field = 0;
  bool about_field = false;
};

/// The short name of the reason, for counting by reason: "bad magic", "not finite", ...
const char* name(Reason) noexcept;

/// One line for users: "field 9 is not a number", "bad magic: does not begin with DMC01", ...
std::string describe(const Fault&);

}  // namespace trk_bridge::wire
