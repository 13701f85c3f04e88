#include "trk_bridge/wire/codec.h"

#include <algorithm>

#include "layout_detector.h"
#include "words.h"

namespace trk_bridge::wire {

namespace {

constexpr std::string_view magic("DMC01\0", 6);
constexpr std::size_t type_at = 6;
constexpr std::size_t encoding_at = 7;
static_assert(encoding_at + 1 == header_size);

constexpr char type_of(const CameraParams&) noexcept { return 'P'; }
constexpr char type_of(const CameraConstants&) noexcept { return 'C'; }

tl::unexpected<Fault> refuse(Reason reason) noexcept { return tl::unexpected(Fault{reason}); }

/// `text` up to its NUL; behind that only white space and more of them are allowed.
tl::expected<std::string_view, Fault> up_to_nul(std::string_view text) noexcept {
  const std::size_t end = std::min(text.find('\0'), text.size());
  const std::string_view rest = text.substr(end);
  const bool blank = std::all_of(rest.begin(), rest.end(), [](char c) { return c == '\0' || is_space(c); });
  if (!blank) return refuse(Reason::trailing_text);
  return text.substr(0, end);
}

template <class Record>
tl::expected<Decoded, Fault> as_decoded(const tl::expected<Record, Fault>& record) noexcept {
  if (!record) return tl::unexpected(record.error());
  return Decoded{*record, {Encoding::ascii, {}}};
}

template <class Record>
tl::expected<std::string_view, Fault> encode_record(const Record& record, WireForm form, Buffer& buffer) noexcept {
  Buffer payload;
  const bool ascii = form.encoding == Encoding::ascii;
  const auto written = ascii ? to_text(record, payload) : to_image(record, form.layout, payload);
  if (!written) return written;
  char* end = std::copy(magic.begin(), magic.end(), buffer.begin());
  *end++ = type_of(record);
  *end++ = ascii ? 'A' : 'B';
  end = std::copy(written->begin(), written->end(), end);
  if (ascii) *end++ = '\0';
  return std::string_view(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
}

}  // namespace

tl::expected<Decoded, Fault> decode(std::string_view datagram, LayoutDetector& detector) noexcept {
  if (datagram.size() > max_datagram) return refuse(Reason::too_long);
  const std::string_view begin = datagram.substr(0, magic.size());
  if (begin != magic.substr(0, begin.size())) return refuse(Reason::bad_magic);
  if (datagram.size() <= type_at) return refuse(Reason::truncated);
  const char type = datagram[type_at];
  if (type != 'P' && type != 'C') return refuse(Reason::bad_type);
  if (datagram.size() <= encoding_at) return refuse(Reason::truncated);
  const std::string_view payload = datagram.substr(header_size);
  switch (datagram[encoding_at]) {
    case 'A': {
      const auto text = up_to_nul(payload);
      if (!text) return tl::unexpected(text.error());
      return type == 'P' ? as_decoded(params_from_text(*text)) : as_decoded(constants_from_text(*text));
    }
    case 'B':
      return type == 'P' ? LayoutDetectorAccess::params(payload, detector)
                         : LayoutDetectorAccess::constants(payload, detector);
    default:
      return refuse(Reason::bad_encoding);
  }
}

tl::expected<std::string_view, Fault> encode(const CameraParams& params, WireForm form, Buffer& buffer) noexcept {
  return encode_record(params, form, buffer);
}

tl::expected<std::string_view, Fault> encode(const CameraConstants& constants, WireForm form, Buffer& buffer) noexcept {
  return encode_record(constants, form, buffer);
}

}  // namespace trk_bridge::wire
