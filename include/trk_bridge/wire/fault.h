// Why bytes are not a record, or a record cannot be written.
#pragma once

#include <cstdint>
#include <string>

namespace trk_bridge::wire {

/// What is wrong with bytes, or with a record that is to be written.
enum class Reason : std::uint8_t {
  too_long,         ///< more than max_datagram bytes
  truncated,        ///< shorter than its header, or ended before its last field
  bad_magic,        ///< does not begin with DMC01 and a NUL
  bad_type,         ///< neither P nor C
  bad_encoding,     ///< neither A nor B
  not_a_number,     ///< field N is not a number
  out_of_range,     ///< field N does not fit its type
  not_finite,       ///< field N is NaN or infinite
  trailing_text,    ///< more than white space after the last field
  wrong_size,       ///< no known layout has a binary record of this size
  layout_mismatch,  ///< the size is not that of the layout given by the user
  no_valid_layout,  ///< right size, but no layout gives a valid record
};

/// A reason and, where it is about one field, which: `field` is its 1-based place in the ASCII order with the format
/// word (or imageWidth) as field 1, and the id as field 0, in binary records alike; the bottom row of a binary
/// matrix, which text does not carry, takes the places of the row above it. `field` counts only with `about_field`.
/// Cheap to copy; never allocates.
struct Fault {
  Reason reason;
  std::uint8_t field = 0;
  bool about_field = false;
};

/// The reason's short name, for counting by reason: "bad magic", "not finite", ...
const char* name(Reason) noexcept;

/// One line for a person: "field 9 is not a number", "bad magic: does not begin with DMC01", ...
std::string describe(const Fault&);

}  // namespace trk_bridge::wire
