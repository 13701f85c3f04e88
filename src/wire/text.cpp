// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "number.h"
#include "payload.h"
#include "places.h"
#include "plain_number.h"
#include "shortest.h"
#include "trk_bridge/wire/fields.h"
#include "words.h"

namespace trk_bridge::wire {

namespace {

/// Reads the fields of a record from a text, one after another, until one is wrong.
class Reader {
 public:
  explicit Reader(std::string_view text) noexcept : at_(text.data()), end_(text.data() + text.size()), last_(end_) {
    while (last_ != at_ && !is_space(last_[-1])) --last_;
  }

  /// The optional first word.
  void id(std::uint32_t& value) noexcept {
    skip_space();
    if (at_ != end_ && *at_ == 'I')
      field(id_place, [&](std::string_view w) { return read_digits(w.substr(1), value); });
  }

  void format(std::uint32_t& value) noexcept {
    field(format_place, [&value](std::string_view word) { return read_hexadecimal(word, value); });
  }

  template <class T>
  void number(std::size_t place, T& value) noexcept {
    if (fault_) return;
    skip_space();
    const char* after = nullptr;
    if constexpr (std::is_floating_point_v<T>) {
      if (at_ < last_) after = read_plain_number(at_, end_, value);
    } else if constexpr (std::is_unsigned_v<T>) {
      after = read_plain_number(at_, end_, value);
    }
    if (after != nullptr) {
      at_ = after;
      return;
    }
    field(place, [&value](std::string_view word) { return read_number(word, value); });
  }

  /// A visitor that reads consecutive fields, the first of which has this place.
  auto numbers_from(std::size_t place) noexcept {
    return [this, place](const Field&, auto& value) mutable { number(place++, value); };
  }

  /// False if there was a fault, which is the first one. Text after the last field is a fault, too.
  bool finish(Fault& fault) noexcept {
    skip_space();
    if (at_ != end_) fault_.note({Reason::trailing_text});
    if (fault_) fault = *fault_;
    return !fault_;
  }

 private:
  void skip_space() noexcept {
    while (at_ != end_ && is_space(*at_)) ++at_;
  }

  template <class Read>
  void field(std::size_t place, Read read) noexcept {
    if (fault_) return;
    std::string_view rest(at_, static_cast<std::size_t>(end_ - at_));
    const std::string_view word = take_word(rest);
    at_ = end_ - rest.size();
    const NumberFault reason = word.empty() ? Reason::truncated : read(word);
    if (reason) fault_.note(about_field(*reason, place));
  }

  const char* at_;
  const char* const end_;
  const char* last_;  // the last word, which is not followed by white space
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

/// Writes the fields of a record, separated by one space, until one cannot be written.
class TextWriter {
 public:
  explicit TextWriter(char* to, TextCache* cache = nullptr) noexcept : begin_(to), at_(to), cache_(cache) {}
  static_assert(sizeof TextCache::Number::text == longest_number);

  void id(std::uint32_t value) noexcept {
    if (value == 0) return;
    *at_++ = 'I';
    at_ = std::to_chars(at_, limit(), value).ptr;
  }

  void format(std::uint32_t value) noexcept {
    separate();
    char* const end = std::to_chars(at_, limit(), value, 16).ptr;
    for (; at_ != end; ++at_) {
      if (*at_ >= 'a') *at_ = static_cast<char>(*at_ - 'a' + 'A');
    }
  }

  void number(std::size_t place, double value) noexcept {
    if (!std::isfinite(value)) return fault_.note(about_field(Reason::not_finite, place));
    separate();
    if (cache_ == nullptr) {
      at_ = write_shortest(value, at_);
      return;
    }
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    TextCache::Number& last = cache_->numbers_[place - transform_place];
    if (last.bits != bits || last.length == 0) {
      char* const end = write_shortest(value, at_);
      last.bits = bits;
      last.length = static_cast<std::uint8_t>(end - at_);
      std::memcpy(last.text.data(), at_, last.text.size());
    } else {
      std::memcpy(at_, last.text.data(), last.text.size());
    }
    at_ += last.length;
  }

  template <class Integer>
  void number(std::size_t, Integer value) noexcept {
    separate();
    at_ = std::to_chars(at_, limit(), value).ptr;
  }

  /// A visitor that writes consecutive fields, the first of which has this place.
  auto numbers_from(std::size_t place) noexcept {
    return [this, place](const Field&, auto value) mutable { number(place++, value); };
  }

  /// The number of bytes written; 0 and the first fault if there was one.
  std::size_t finish(Fault& fault) const noexcept {
    if (fault_) fault = *fault_;
    return fault_ ? 0 : static_cast<std::size_t>(at_ - begin_);
  }

 private:
  char* limit() const noexcept { return begin_ + payload_room; }
  void separate() noexcept {
    if (at_ != begin_) *at_++ = ' ';
  }

  char* const begin_;
  char* at_;
  TextCache* const cache_;
  FirstFault fault_;
};

bool read_text(std::string_view text, CameraParams& into, Fault& fault) noexcept {
  Reader reader(text);
  into.id = 0;
  reader.id(into.id);
  reader.format(into.format);
  clear_unselected(into);
  if (has(into.format, euler)) {
    for_each_euler_field(reader.numbers_from(transform_place), into.euler);
  } else {
    read_matrix(reader, into.matrix);
  }
  for_each_lens_field(reader.numbers_from(lens_place(into.format)), into);
  reader.number(counter_place(into.format), into.counter);
  return reader.finish(fault);
}

bool read_text(std::string_view text, CameraConstants& into, Fault& fault) noexcept {
  Reader reader(text);
  into.id = 0;
  reader.id(into.id);
  for_each_image_field(reader.numbers_from(image_place), into);
  for_each_chip_field(reader.numbers_from(chip_place), into);
  return reader.finish(fault);
}

namespace {

std::size_t write_params(const CameraParams& p, TextWriter&& writer, Fault& fault) noexcept {
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
  return writer.finish(fault);
}

}  // namespace

std::size_t write_text(const CameraParams& p, char* to, Fault& fault) noexcept {
  return write_params(p, TextWriter(to), fault);
}

std::size_t write_text(const CameraParams& p, char* to, Fault& fault, TextCache& cache) noexcept {
  return write_params(p, TextWriter(to, &cache), fault);
}

std::size_t write_text(const CameraConstants& c, char* to, Fault& fault) noexcept {
  TextWriter writer(to);
  writer.id(c.id);
  for_each_image_field(writer.numbers_from(image_place), c);
  for_each_chip_field(writer.numbers_from(chip_place), c);
  return writer.finish(fault);
}

}  // namespace trk_bridge::wire
