#include "record_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>
#include <variant>

#include <rapidjson/writer.h>

#include "base/time_text.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::tools {
namespace {

using NumberText = std::array<char, 32>;

std::string_view shortest(double value, NumberText& into) {
  const auto result = std::to_chars(into.data(), into.data() + into.size(), value);
  return {into.data(), static_cast<std::size_t>(result.ptr - into.data())};
}

class JsonRecord {
 public:
  explicit JsonRecord(rapidjson::StringBuffer& buffer) : writer_(buffer) {}

  void write(const transport::Sample& sample) {
    writer_.StartObject();
    std::visit([&](const auto& record) { body(record, sample); }, sample.record);
    writer_.EndObject();
  }

 private:
  void body(const wire::CameraParams& p, const transport::Sample& sample) {
    origin("params", p.id, sample);
    integer("format", p.format);
    text("format_words", wire::format_to_words(p.format));
    integer("counter", p.counter);
    if (wire::has(p.format, wire::euler)) {
      writer_.Key("euler");
      writer_.StartObject();
      number("x", p.euler.x);
      number("y", p.euler.y);
      number("z", p.euler.z);
      number("pan", p.euler.pan);
      number("tilt", p.euler.tilt);
      number("roll", p.euler.roll);
      writer_.EndObject();
    } else {
      writer_.Key("matrix");
      writer_.StartArray();
      for (const double element : p.matrix) value(element);
      writer_.EndArray();
    }
    number("fov", p.fov);
    number("center_x", p.center_x);
    number("center_y", p.center_y);
    number("k1", p.k1);
    number("k2", p.k2);
    number("focdist", p.focdist);
    number("aperture", p.aperture);
  }

  void body(const wire::CameraConstants& c, const transport::Sample& sample) {
    origin("constants", c.id, sample);
    integer("imageWidth", c.image_width);
    integer("imageHeight", c.image_height);
    integer("blankLeft", c.blank_left);
    integer("blankRight", c.blank_right);
    integer("blankTop", c.blank_top);
    integer("blankBottom", c.blank_bottom);
    number("chipWidth", c.chip_width);
    number("chipHeight", c.chip_height);
    number("fakeChipWidth", c.fake_chip_width);
    number("fakeChipHeight", c.fake_chip_height);
  }

  void origin(const char* type, std::uint32_t id, const transport::Sample& sample) {
    text("type", type);
    integer("id", id);
    writer_.Key("arrival");
    raw(base::seconds_text(sample.arrival));
    text("sender", transport::to_string(sample.sender));
  }

  void text(const char* key, const std::string& content) {
    writer_.Key(key);
    writer_.String(content);
  }

  template <typename Integer>
  void integer(const char* key, Integer content) {
    writer_.Key(key);
    if constexpr (std::is_signed_v<Integer>) {
      writer_.Int64(content);
    } else {
      writer_.Uint64(content);
    }
  }

  void number(const char* key, double content) {
    writer_.Key(key);
    value(content);
  }

  void value(double content) {
    NumberText buffer;
    if (!std::isfinite(content)) {
      writer_.Null();
    } else if (content == 0 && std::signbit(content)) {
      // Readers take -0 for an integer and lose its sign.
      raw("-0.0");
    } else {
      raw(shortest(content, buffer));
    }
  }

  void raw(std::string_view number_text) {
    writer_.RawValue(number_text.data(), number_text.size(), rapidjson::kNumberType);
  }

  rapidjson::Writer<rapidjson::StringBuffer> writer_;
};

class PlainRecord {
 public:
  explicit PlainRecord(const transport::Sample& sample)
      : line_(base::iso_time(sample.arrival) + " " + transport::to_string(sample.sender)) {
    std::visit([this](const auto& record) { body(record); }, sample.record);
  }
  std::string take() { return std::move(line_); }

 private:
  void body(const wire::CameraParams& p) {
    line_ += " id " + std::to_string(p.id) + " params " + std::to_string(p.counter) + " [" +
             wire::format_to_words(p.format) + "]";
    if ((p.format & ~wire::known_format_bits) != 0) {
      std::array<char, 16> unknown{};
      std::snprintf(unknown.data(), unknown.size(), "0x%X", p.format & ~wire::known_format_bits);
      line_ += std::string(" unknown format bits ") + unknown.data();
    }
    if (wire::has(p.format, wire::euler)) {
      numbers("", {p.euler.x, p.euler.y, p.euler.z}, "m");
      numbers("pan tilt roll", {p.euler.pan, p.euler.tilt, p.euler.roll}, "deg");
    } else {
      line_ += " matrix columns";
      for (const double element : p.matrix) number(element);
    }
    const bool is_angle = wire::has(p.format, wire::field_of_view);
    numbers(is_angle ? "field of view" : "image distance", {p.fov}, is_angle ? "deg" : "mm");
    numbers("center", {p.center_x, p.center_y}, wire::has(p.format, wire::shift_in_pixels) ? "px" : "mm");
    numbers("k1", {p.k1}, "mm^-2");
    numbers("k2", {p.k2}, "mm^-4");
    numbers("focdist", {p.focdist}, "m");
    numbers("aperture", {p.aperture}, "");
  }

  void body(const wire::CameraConstants& c) {
    line_ += " id " + std::to_string(c.id) + " constants image " + std::to_string(c.image_width) + " x " +
             std::to_string(c.image_height) + " px blanks left " + std::to_string(c.blank_left) + " right " +
             std::to_string(c.blank_right) + " top " + std::to_string(c.blank_top) + " bottom " +
             std::to_string(c.blank_bottom) + " px";
    numbers("chip", {c.chip_width, c.chip_height}, "mm");
    numbers("fake chip", {c.fake_chip_width, c.fake_chip_height}, "mm");
  }

  void numbers(const char* what, std::initializer_list<double> values, const char* unit) {
    if (*what != '\0') line_ += std::string(" ") + what;
    for (const double v : values) number(v);
    if (*unit != '\0') line_ += std::string(" ") + unit;
  }

  void number(double value) {
    NumberText buffer;
    line_ += ' ';
    line_ += shortest(value, buffer);
  }

  std::string line_;
};

}  // namespace

std::string_view JsonLine::of(const transport::Sample& sample) {
  buffer_.Clear();
  JsonRecord(buffer_).write(sample);
  return {buffer_.GetString(), buffer_.GetSize()};
}

std::string plain_line(const transport::Sample& sample) { return PlainRecord(sample).take(); }

}  // namespace trk_bridge::tools
