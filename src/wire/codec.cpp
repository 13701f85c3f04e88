// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/codec.h"

#include <algorithm>
#include <cstring>

#include "layout_detector.h"
#include "payload.h"
#include "words.h"

namespace trk_bridge::wire {

namespace {

constexpr std::string_view magic("DMC01\0", 6);
constexpr std::size_t type_at = 6;
constexpr std::size_t encoding_at = 7;
static_assert(encoding_at + 1 == header_size);

constexpr char type_of(const CameraParams&) noexcept { return 'P'; }
constexpr char type_of(const CameraConstants&) noexcept { return 'C'; }

/// Whether the text has only white space and NULs.
bool is_blank(std::string_view text) noexcept {
  return std::all_of(text.begin(), text.end(), [](char c) { return c == '\0' || is_space(c); });
}

template <class T, class... Cache>
tl::expected<std::string_view, Fault> encode_record(const T& record, WireForm form, Buffer& buffer,
                                                    Cache&... cache) noexcept {
  const bool ascii = form.encoding == Encoding::ascii;
  char* const payload = buffer.data() + header_size;
  Fault fault{};
  const std::size_t size =
      ascii ? write_text(record, payload, fault, cache...) : write_image(record, form.layout, payload, fault);
  if (size == 0) return tl::unexpected(fault);
  std::copy(magic.begin(), magic.end(), buffer.begin());
  buffer[type_at] = type_of(record);
  buffer[encoding_at] = ascii ? 'A' : 'B';
  if (ascii) payload[size] = '\0';
  return std::string_view(buffer.data(), header_size + size + (ascii ? 1 : 0));
}

/// Returns the record that `read` reads.
template <class T, class Read>
tl::expected<T, Fault> record_of(Read&& read) noexcept {
  tl::expected<T, Fault> record;
  Fault fault{};
  if (!read(*record, fault)) return tl::unexpected(fault);
  return record;
}

/// Returns what `write` writes into the buffer.
template <class Write>
tl::expected<std::string_view, Fault> written_to(Buffer& buffer, Write&& write) noexcept {
  Fault fault{};
  const std::size_t size = write(buffer.data(), fault);
  if (size == 0) return tl::unexpected(fault);
  return std::string_view(buffer.data(), size);
}

}  // namespace

bool decode(std::string_view datagram, LayoutDetector& detector, Record& into, DecodedForm& form,
            Fault& fault) noexcept {
  const auto refuse = [&fault](Reason reason) {
    fault = {reason};
    return false;
  };
  if (datagram.size() > max_datagram) return refuse(Reason::too_long);
  // With a constant length, the compiler makes no function call.
  const bool has_magic = datagram.size() < magic.size() ? datagram == magic.substr(0, datagram.size())
                                                        : std::memcmp(datagram.data(), magic.data(), magic.size()) == 0;
  if (!has_magic) return refuse(Reason::bad_magic);
  if (datagram.size() <= type_at) return refuse(Reason::truncated);
  const char type = datagram[type_at];
  if (type != 'P' && type != 'C') return refuse(Reason::bad_type);
  if (datagram.size() <= encoding_at) return refuse(Reason::truncated);
  const std::string_view payload = datagram.substr(header_size);
  switch (datagram[encoding_at]) {
    case 'A': {
      const std::size_t end = std::min(payload.find('\0'), payload.size());
      if (!is_blank(payload.substr(end))) return refuse(Reason::trailing_text);
      const std::string_view text = payload.substr(0, end);
      form = {};
      return type == 'P' ? read_text(text, record_in<CameraParams>(into), fault)
                         : read_text(text, record_in<CameraConstants>(into), fault);
    }
    case 'B':
      return type == 'P' ? LayoutDetectorAccess::params(payload, detector, into, form, fault)
                         : LayoutDetectorAccess::constants(payload, detector, into, form, fault);
    default:
      return refuse(Reason::bad_encoding);
  }
}

tl::expected<Decoded, Fault> decode(std::string_view datagram, LayoutDetector& detector) noexcept {
  tl::expected<Decoded, Fault> decoded;
  Fault fault{};
  if (!decode(datagram, detector, decoded->record, *decoded, fault)) return tl::unexpected(fault);
  return decoded;
}

tl::expected<std::string_view, Fault> encode(const CameraParams& params, WireForm form, Buffer& buffer) noexcept {
  return encode_record(params, form, buffer);
}

tl::expected<std::string_view, Fault> encode(const CameraParams& params, WireForm form, Buffer& buffer,
                                             TextCache& cache) noexcept {
  return encode_record(params, form, buffer, cache);
}

tl::expected<std::string_view, Fault> encode(const CameraConstants& constants, WireForm form, Buffer& buffer) noexcept {
  return encode_record(constants, form, buffer);
}

tl::expected<std::string_view, Fault> to_text(const CameraParams& p, Buffer& buffer) noexcept {
  return written_to(buffer, [&](char* to, Fault& fault) { return write_text(p, to, fault); });
}
tl::expected<std::string_view, Fault> to_text(const CameraConstants& c, Buffer& buffer) noexcept {
  return written_to(buffer, [&](char* to, Fault& fault) { return write_text(c, to, fault); });
}
tl::expected<std::string_view, Fault> to_image(const CameraParams& p, Layout layout, Buffer& buffer) noexcept {
  return written_to(buffer, [&](char* to, Fault& fault) { return write_image(p, layout, to, fault); });
}
tl::expected<std::string_view, Fault> to_image(const CameraConstants& c, Layout layout, Buffer& buffer) noexcept {
  return written_to(buffer, [&](char* to, Fault& fault) { return write_image(c, layout, to, fault); });
}

tl::expected<CameraParams, Fault> params_from_text(std::string_view text) noexcept {
  return record_of<CameraParams>([&](CameraParams& into, Fault& fault) { return read_text(text, into, fault); });
}
tl::expected<CameraConstants, Fault> constants_from_text(std::string_view text) noexcept {
  return record_of<CameraConstants>([&](CameraConstants& into, Fault& fault) { return read_text(text, into, fault); });
}
tl::expected<CameraParams, Fault> params_from_image(std::string_view image, Layout layout) noexcept {
  return record_of<CameraParams>(
      [&](CameraParams& into, Fault& fault) { return read_image(image, layout, into, fault); });
}
tl::expected<CameraConstants, Fault> constants_from_image(std::string_view image, Layout layout) noexcept {
  return record_of<CameraConstants>(
      [&](CameraConstants& into, Fault& fault) { return read_image(image, layout, into, fault); });
}

}  // namespace trk_bridge::wire
