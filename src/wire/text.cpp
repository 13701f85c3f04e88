#include <charconv>
#include <cmath>
#include <type_traits>

#include "number.h"
#include "places.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/fields.h"
#include "words.h"

namespace trk_bridge::wire {

namespace {

/// Takes the fields of a record off a text, one after another, until one is wrong.
class Reader {
 public:
  explicit Reader(std::string_view text) noexcept : text_(text) {}

  /// The optional first word.
  void id(std::uint32_t& value) noexcept {
    std::string_view rest = text_;
    const std::string_view word = take_word(rest);
    if (word.empty() || word.front() != 'I') return;
    text_ = rest;
    note(read_digits(word.substr(1), value), id_place);
  }

  void format(std::uint32_t& value) noexcept {
    const auto read = [&value](std::string_view word) { return read_hexadecimal(word, value); };
    field(format_place, read);
  }

  template <class T>
  void number(std::size_t place, T& value) noexcept {
    field(place, [&value](std::string_view word) { return read_number(word, value); });
  }

  /// A visitor of consecutive fields, the first of which has this place.
  auto numbers_from(std::size_t place) noexcept {
    return [this, place](const Field&, auto& value) mutable { number(place++, value); };
  }

  /// The first fault, counting what stands behind the last field.
  FirstFault finish() noexcept {
    if (!take_word(text_).empty()) fault_.note({Reason::trailing_text});
    return fault_;
  }

 private:
  template <class Read>
  void field(std::size_t place, Read read) noexcept {
    if (fault_) return;
    const std::string_view word = take_word(text_);
    note(word.empty() ? NumberFault(Reason::truncated) : read(word), place);
  }

  void note(NumberFault reason, std::size_t place) noexcept {
    if (reason) fault_.note(about_field(*reason, place));
  }

  std::string_view text_;
  FirstFault fault_;
};

// The longest number is a double such as -2.2250738585072014e-308, the widest record a matrix with its id.
constexpr std::size_t longest_number = 24;
static_assert(header_size + 22 * (longest_number + 1) + 1 <= max_datagram, "every record fits its datagram");

/// Puts the fields of a record one after another, one space between, until one cannot be written.
class Writer {
 public:
  explicit Writer(Buffer& buffer) noexcept : buffer_(buffer) {}

  void id(std::uint32_t value) noexcept {
    if (value == 0) return;
    buffer_[end_++] = 'I';
    end_ = static_cast<std::size_t>(std::to_chars(here(), limit(), value).ptr - buffer_.data());
  }

  void format(std::uint32_t value) noexcept {
    separate();
    char* const begin = here();
    char* const end = std::to_chars(begin, limit(), value, 16).ptr;
    for (char* c = begin; c != end; ++c) {
      if (*c >= 'a') *c = static_cast<char>(*c - 'a' + 'A');
    }
    end_ = static_cast<std::size_t>(end - buffer_.data());
  }

  template <class T>
  void number(std::size_t place, T value) noexcept {
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) fault_.note(about_field(Reason::not_finite, place));
    }
    separate();
    end_ = static_cast<std::size_t>(std::to_chars(here(), limit(), value).ptr - buffer_.data());
  }

  /// A visitor of consecutive fields, the first of which has this place.
  auto numbers_from(std::size_t place) noexcept {
    return [this, place](const Field&, auto value) mutable { number(place++, value); };
  }

  tl::expected<std::string_view, Fault> finish() const noexcept {
    if (fault_) return tl::unexpected(*fault_);
    return std::string_view(buffer_.data(), end_);
  }

 private:
  char* here() noexcept { return buffer_.data() + end_; }
  char* limit() noexcept { return buffer_.data() + buffer_.size(); }
  void separate() noexcept {
    if (end_ != 0) buffer_[end_++] = ' ';
  }

  Buffer& buffer_;
  std::size_t end_ = 0;
  FirstFault fault_;
};

void read_matrix(Reader& reader, std::array<double, 16>& matrix) noexcept {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    if (i % 4 < text_rows) {
      reader.number(matrix_place(i), matrix[i]);
    } else {
      matrix[i] = i == 15 ? 1 : 0;
    }
  }
}

}  // namespace

tl::expected<CameraParams, Fault> params_from_text(std::string_view text) noexcept {
  CameraParams p;
  Reader reader(text);
  reader.id(p.id);
  reader.format(p.format);
  if (has(p.format, euler)) {
    for_each_euler_field(reader.numbers_from(transform_place), p.euler);
  } else {
    read_matrix(reader, p.matrix);
  }
  for_each_lens_field(reader.numbers_from(lens_place(p.format)), p);
  reader.number(counter_place(p.format), p.counter);
  if (const auto fault = reader.finish()) return tl::unexpected(*fault);
  return p;
}

tl::expected<CameraConstants, Fault> constants_from_text(std::string_view text) noexcept {
  CameraConstants c;
  Reader reader(text);
  reader.id(c.id);
  for_each_image_field(reader.numbers_from(image_place), c);
  for_each_chip_field(reader.numbers_from(chip_place), c);
  if (const auto fault = reader.finish()) return tl::unexpected(*fault);
  return c;
}

tl::expected<std::string_view, Fault> to_text(const CameraParams& p, Buffer& buffer) noexcept {
  Writer writer(buffer);
  writer.id(p.id);
  writer.format(p.format);
  if (has(p.format, euler)) {
    for_each_euler_field(writer.numbers_from(transform_place), p.euler);
  } else {
    for (std::size_t i = 0; i < p.matrix.size(); ++i) {
      if (i % 4 < text_rows) writer.number(matrix_place(i), p.matrix[i]);
    }
  }
  for_each_lens_field(writer.numbers_from(lens_place(p.format)), p);
  writer.number(counter_place(p.format), p.counter);
  return writer.finish();
}

tl::expected<std::string_view, Fault> to_text(const CameraConstants& c, Buffer& buffer) noexcept {
  Writer writer(buffer);
  writer.id(c.id);
  for_each_image_field(writer.numbers_from(image_place), c);
  for_each_chip_field(writer.numbers_from(chip_place), c);
  return writer.finish();
}

}  // namespace trk_bridge::wire
