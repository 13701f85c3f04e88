// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "record_text.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <variant>

#include <rapidjson/writer.h>

#include "base/number_text.h"
#include "base/time_text.h"
#include "trk_bridge/wire/fields.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::tools {
namespace {

/// Calls `put` with name and count of each known encoder.
template <typename Put>
void for_each_encoder(Put&& put, const transport::LensEncoders& encoders) {
  if (encoders.zoom) put("zoom_encoder", *encoders.zoom);
  if (encoders.focus) put("focus_encoder", *encoders.focus);
  if (encoders.iris) put("iris_encoder", *encoders.iris);
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
    const auto put = [this](const wire::Field& field, double content) { number(field.name, content); };
    if (wire::has(p.format, wire::euler)) {
      writer_.Key("euler");
      writer_.StartObject();
      wire::for_each_euler_field(put, p.euler);
      writer_.EndObject();
    } else {
      writer_.Key("matrix");
      writer_.StartArray();
      for (const double element : p.matrix) value(element);
      writer_.EndArray();
    }
    if (sample.has_lens) wire::for_each_lens_field(put, p);
    for_each_encoder([this](const char* name, std::int32_t count) { integer(name, count); }, sample.encoders);
    if (*sample.doubt != '\0') text("doubt", sample.doubt);
  }

  void body(const wire::CameraConstants& c, const transport::Sample& sample) {
    origin("constants", c.id, sample);
    const auto put_integer = [this](const wire::Field& field, std::int32_t content) {
      integer(field.document_name, content);
    };
    const auto put_number = [this](const wire::Field& field, double content) { number(field.document_name, content); };
    wire::for_each_image_field(put_integer, c);
    wire::for_each_chip_field(put_number, c);
  }

  void origin(const char* type, std::uint32_t id, const transport::Sample& sample) {
    text("type", type);
    integer("id", id);
    writer_.Key("arrival");
    raw(base::seconds_text(sample.arrival));
    text("sender", transport::to_string(sample.sender));
    if (sample.time_code) text("time_code", base::to_string(sample.time_code->code));
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
    if (!std::isfinite(content)) {
      writer_.Null();
    } else if (content == 0 && std::signbit(content)) {
      // Readers parse -0 as an integer and lose its sign.
      raw("-0.0");
    } else {
      raw(base::number_text(content));
    }
  }

  void raw(std::string_view number_text) {
    writer_.RawValue(number_text.data(), number_text.size(), rapidjson::kNumberType);
  }

  rapidjson::Writer<rapidjson::StringBuffer> writer_;
};

/// The text before the number of a field in a plain line, and whether its unit follows.
struct Wording {
  std::string_view field, before;
  bool unit_follows;
};

/// Fields that are not printed as name, number, unit.
constexpr Wording wordings[] = {{"x", "", false},
                                {"y", "", false},
                                {"z", "", true},
                                {"pan", "pan tilt roll", false},
                                {"tilt", "", false},
                                {"roll", "", true},
                                {"center_x", "center", false},
                                {"center_y", "", true},
                                {"image_width", "image", false},
                                {"image_height", "x", true},
                                {"blank_left", "blanks left", false},
                                {"blank_right", "right", false},
                                {"blank_top", "top", false},
                                {"blank_bottom", "bottom", true},
                                {"chip_width", "chip", false},
                                {"chip_height", "", true},
                                {"fake_chip_width", "fake chip", false},
                                {"fake_chip_height", "", true}};

Wording wording_of(const wire::Field& field, std::uint32_t format) {
  const std::string_view name = field.name;
  if (name == "fov") return {name, wire::has(format, wire::field_of_view) ? "field of view" : "image distance", true};
  for (const Wording& wording : wordings) {
    if (wording.field == name) return wording;
  }
  return {name, name, true};
}

class PlainRecord {
 public:
  explicit PlainRecord(const transport::Sample& sample)
      : line_(base::iso_time(sample.arrival) + " " + transport::to_string(sample.sender)) {
    if (sample.time_code) line_ += " " + base::to_string(sample.time_code->code);
    std::visit([&](const auto& record) { body(record, sample); }, sample.record);
    if (*sample.doubt != '\0') line_ += std::string(" (") + sample.doubt + ")";
  }
  std::string finish() { return std::move(line_); }

 private:
  void body(const wire::CameraParams& p, const transport::Sample& sample) {
    line_ += " id " + std::to_string(p.id) + " params " + std::to_string(p.counter) + " [" +
             wire::format_to_words(p.format) + "]";
    if ((p.format & ~wire::known_format_bits) != 0) {
      std::array<char, 16> unknown{};
      std::snprintf(unknown.data(), unknown.size(), "0x%X", p.format & ~wire::known_format_bits);
      line_ += std::string(" unknown format bits ") + unknown.data();
    }
    const auto put = [this, &p](const wire::Field& field, double value) { put_field(field, value, p.format); };
    if (wire::has(p.format, wire::euler)) {
      wire::for_each_euler_field(put, p.euler);
    } else {
      line_ += " matrix columns";
      for (const double element : p.matrix) number(element);
    }
    if (sample.has_lens) wire::for_each_lens_field(put, p);
    for_each_encoder(
        [this](const char* name, std::int32_t count) {
          word(name);
          number(count);
        },
        sample.encoders);
    if (!sample.has_lens) word("no lens");
  }

  void body(const wire::CameraConstants& c, const transport::Sample&) {
    line_ += " id " + std::to_string(c.id) + " constants";
    const auto put = [this](const wire::Field& field, auto value) { put_field(field, value, 0); };
    wire::for_each_image_field(put, c);
    wire::for_each_chip_field(put, c);
  }

  template <typename Number>
  void put_field(const wire::Field& field, Number value, std::uint32_t format) {
    const Wording wording = wording_of(field, format);
    word(wording.before);
    number(value);
    if (wording.unit_follows) word(field.unit_in(format));
  }

  void word(std::string_view text) {
    if (text.empty()) return;
    line_ += ' ';
    line_ += text;
  }

  template <typename Number>
  void number(Number value) {
    word(base::number_text(value));
  }

  std::string line_;
};

}  // namespace

std::string_view JsonLine::of(const transport::Sample& sample) {
  buffer_.Clear();
  JsonRecord(buffer_).write(sample);
  return {buffer_.GetString(), buffer_.GetSize()};
}

std::string plain_line(const transport::Sample& sample) { return PlainRecord(sample).finish(); }

}  // namespace trk_bridge::tools
