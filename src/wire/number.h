// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Converts words of ASCII records to numbers with std::from_chars: exact, and the same in every locale. For all words;
// plain_number.h is faster for common ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "trk_bridge/wire/fault.h"

namespace trk_bridge::wire {

/// Why a word is not a valid number; empty if it is.
using NumberFault = std::optional<Reason>;

/// Decimal as for strtod, but not hexadecimal. Too large is out_of_range; too small is 0, with its sign; the words for
/// NaN and infinity are not_finite.
NumberFault read_number(std::string_view word, double& value) noexcept;

/// Decimal with an optional sign; leading zeros have no effect.
NumberFault read_number(std::string_view word, std::int32_t& value) noexcept;
NumberFault read_number(std::string_view word, std::uint64_t& value) noexcept;

/// Decimal digits only.
NumberFault read_digits(std::string_view word, std::uint32_t& value) noexcept;

/// Hexadecimal in either case, with or without 0x.
NumberFault read_hexadecimal(std::string_view word, std::uint32_t& value) noexcept;

}  // namespace trk_bridge::wire
