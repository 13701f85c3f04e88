// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Encodes and decodes records in memory: datagrams, ASCII text and binary images. Nothing here allocates, locks, logs,
// depends on the locale or reads beyond its input. All functions may be called from any thread on separate objects.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/wire/fault.h"
#include "trk_bridge/wire/layout.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::wire {

/// The longest datagram, and the longest line of a file with its newline.
inline constexpr std::size_t max_datagram = 4096;
/// DMC01, NUL, type, encoding.
inline constexpr std::size_t header_size = 8;

/// A buffer that is large enough for any encoded record.
using Buffer = std::array<char, max_datagram>;

/// Byte 7 of a datagram.
enum class Encoding : std::uint8_t { ascii, binary };

/// How a datagram is encoded; `layout` is used for binary ones.
struct WireForm {
  Encoding encoding = Encoding::ascii;
  Layout layout{};
};

/// How a valid datagram was encoded.
struct DecodedForm {
  WireForm form;
  /// The generation of a binary record is a guess: it is valid in both, and earlier records of the sender do not decide
  /// (`LayoutDetector`).
  bool layout_guessed = false;
};

/// A valid datagram.
struct Decoded : DecodedForm {
  Record record;
};

/// Decodes one datagram. `detector` belongs to its sender and learns from valid binary records.
[[nodiscard]] tl::expected<Decoded, Fault> decode(std::string_view datagram, LayoutDetector& detector) noexcept;
/// The same into an existing record, which is faster. False: `fault` gives the reason, and `into` is unspecified.
[[nodiscard]] bool decode(std::string_view datagram, LayoutDetector& detector, Record& into, DecodedForm& form,
                          Fault& fault) noexcept;

/// A cache of the numbers in the last ASCII parameters, each with its text: numbers that repeat are not formatted
/// again. For one writer, one thread at a time. It does not change the result.
class TextCache {
 private:
  friend class TextWriter;
  struct Number {
    std::uint64_t bits = 0;
    std::uint8_t length = 0;  ///< of the text; 0: empty
    std::array<char, 24> text{};
  };
  std::array<Number, 20> numbers_{};
};

/// Encodes one datagram into `buffer`; the view covers its bytes. ASCII ends with a NUL. Fails for a number that is not
/// finite (not_finite) and for a counter that the layout cannot hold (out_of_range). The generation of the document has
/// no id; it is omitted.
[[nodiscard]] tl::expected<std::string_view, Fault> encode(const CameraParams&, WireForm, Buffer& buffer) noexcept;
/// The same, faster if `cache` was used for the previous record.
[[nodiscard]] tl::expected<std::string_view, Fault> encode(const CameraParams&, WireForm, Buffer& buffer,
                                                           TextCache& cache) noexcept;
[[nodiscard]] tl::expected<std::string_view, Fault> encode(const CameraConstants&, WireForm, Buffer& buffer) noexcept;

/// The ASCII payload without header and NUL, as in files. Numbers are the shortest that read back to the same value;
/// `I<id>` comes first if the id is not 0. Of a matrix, the first three rows are written; the fourth is read as 0 0 0
/// 1.
///
/// Decimal numbers are read as by strtod of C (a leading plus, `1.`, `.5`, exponents), but not hexadecimal ones. A
/// number too large for a double is out_of_range, one too small is 0; the words for NaN and infinity are not_finite.
/// Whole numbers are always decimal (0720 is 720).
[[nodiscard]] tl::expected<std::string_view, Fault> to_text(const CameraParams&, Buffer& buffer) noexcept;
[[nodiscard]] tl::expected<std::string_view, Fault> to_text(const CameraConstants&, Buffer& buffer) noexcept;
/// The inverse; the fault names the field.
[[nodiscard]] tl::expected<CameraParams, Fault> params_from_text(std::string_view text) noexcept;
/// The inverse; the fault names the field.
[[nodiscard]] tl::expected<CameraConstants, Fault> constants_from_text(std::string_view text) noexcept;

/// Reads a binary image without header, as in shared memory; `image` must have the size of the layout (otherwise
/// wrong_size). Any format mask is accepted: only `decode` checks it, to detect the layout.
[[nodiscard]] tl::expected<CameraParams, Fault> params_from_image(std::string_view image, Layout) noexcept;
/// The same for constants.
[[nodiscard]] tl::expected<CameraConstants, Fault> constants_from_image(std::string_view image, Layout) noexcept;
/// The inverse, into `buffer`; fails as encode() does.
[[nodiscard]] tl::expected<std::string_view, Fault> to_image(const CameraParams&, Layout, Buffer& buffer) noexcept;
[[nodiscard]] tl::expected<std::string_view, Fault> to_image(const CameraConstants&, Layout, Buffer& buffer) noexcept;

/// Whether the rotation part of a matrix is orthonormal with determinant +1 to 1e-3, and its bottom row is 0 0 0 1.
[[nodiscard]] bool is_rigid(const std::array<double, 16>& matrix) noexcept;

}  // namespace trk_bridge::wire
