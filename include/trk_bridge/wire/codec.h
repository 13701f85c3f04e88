// Records <-> bytes in memory: datagrams, ASCII text and binary images. Nothing here allocates, locks, logs, looks at
// the locale or reads past what it was given; all functions may be called from any thread on separate objects.
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

/// Room for any encoded record.
using Buffer = std::array<char, max_datagram>;

/// Byte 7 of a datagram.
enum class Encoding : std::uint8_t { ascii, binary };

/// How a datagram was encoded; `layout` counts for binary ones.
struct WireForm {
  Encoding encoding = Encoding::ascii;
  Layout layout{};
};

/// How a valid datagram was encoded.
struct DecodedForm {
  WireForm form;
  /// The generation of a binary record is a guess: both generations fit, and nothing is known of the sender
  /// (`LayoutDetector`).
  bool layout_guessed = false;
};

/// A valid datagram.
struct Decoded : DecodedForm {
  Record record;
};

/// One whole datagram. `detector` is the one of its sender; it learns from good binary records.
[[nodiscard]] tl::expected<Decoded, Fault> decode(std::string_view datagram, LayoutDetector& detector) noexcept;
/// The same into what is there already, which is quicker. False: `fault` says why, and `into` is any record.
[[nodiscard]] bool decode(std::string_view datagram, LayoutDetector& detector, Record& into, DecodedForm& form,
                          Fault& fault) noexcept;

/// The numbers of the last parameters that were written as ASCII, each with its text: what repeats from record to
/// record is not made again. For one writer, from one thread at a time; any use of it gives the same bytes.
class TextCache {
 private:
  friend class TextWriter;
  struct Number {
    std::uint64_t bits = 0;
    std::uint8_t length = 0;  ///< of the text; 0: none yet
    std::array<char, 24> text{};
  };
  std::array<Number, 20> numbers_{};
};

/// One whole datagram into `buffer`; the view covers its bytes. ASCII ends in its NUL. A number that is not finite is
/// refused (not_finite), as is a counter that the layout cannot hold (out_of_range). The id is dropped in the
/// document's generation, which has no place for it.
[[nodiscard]] tl::expected<std::string_view, Fault> encode(const CameraParams&, WireForm, Buffer& buffer) noexcept;
/// The same, quicker where `memory` is that of the record before.
[[nodiscard]] tl::expected<std::string_view, Fault> encode(const CameraParams&, WireForm, Buffer& buffer,
                                                           TextCache& memory) noexcept;
[[nodiscard]] tl::expected<std::string_view, Fault> encode(const CameraConstants&, WireForm, Buffer& buffer) noexcept;

/// The ASCII payload without header and NUL, as it also stands in files. Shortest numbers that read back; a leading
/// `I<id>` only when the id is not 0. Of a matrix the first three rows are written, and the fourth is read as 0 0 0 1.
///
/// Read are decimal numbers as C's strtod takes them (a leading plus, `1.`, `.5`, exponents; nothing hexadecimal). One
/// too large for a double is out_of_range, one too small is 0; the words for NaN and infinity are not_finite. Whole
/// numbers are decimal whatever they begin with (0720 is 720).
[[nodiscard]] tl::expected<std::string_view, Fault> to_text(const CameraParams&, Buffer& buffer) noexcept;
[[nodiscard]] tl::expected<std::string_view, Fault> to_text(const CameraConstants&, Buffer& buffer) noexcept;
/// The record of such a text; the fault names the field.
[[nodiscard]] tl::expected<CameraParams, Fault> params_from_text(std::string_view text) noexcept;
/// The record of such a text; the fault names the field.
[[nodiscard]] tl::expected<CameraConstants, Fault> constants_from_text(std::string_view text) noexcept;

/// The binary image without header, as it also stands in shared memory; `image` must have the layout's size
/// (wrong_size otherwise). Any format mask is taken: only `decode` looks at it, to detect the layout.
[[nodiscard]] tl::expected<CameraParams, Fault> params_from_image(std::string_view image, Layout) noexcept;
/// The same of constants.
[[nodiscard]] tl::expected<CameraConstants, Fault> constants_from_image(std::string_view image, Layout) noexcept;
/// The way back into `buffer`; refuses what encode() refuses.
[[nodiscard]] tl::expected<std::string_view, Fault> to_image(const CameraParams&, Layout, Buffer& buffer) noexcept;
[[nodiscard]] tl::expected<std::string_view, Fault> to_image(const CameraConstants&, Layout, Buffer& buffer) noexcept;

/// Whether the rotation part of a matrix is orthonormal with determinant +1 to 1e-3, and its bottom row 0 0 0 1.
[[nodiscard]] bool is_rigid(const std::array<double, 16>& matrix) noexcept;

}  // namespace trk_bridge::wire
