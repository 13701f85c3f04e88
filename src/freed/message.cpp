// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "message.h"

#include <string>

namespace trk_bridge::freed {
namespace {

using transport::Fault;

constexpr std::uint8_t position_type = 0xD1;
constexpr std::uint8_t first_type = 0xD0, last_type = 0xDB;

// Offsets of the numbers. Each has three bytes, except the camera with one and the spare bytes with two.
constexpr std::size_t camera_at = 1, pan_at = 2, tilt_at = 5, roll_at = 8, x_at = 11, y_at = 14, z_at = 17,
                      zoom_at = 20, focus_at = 23, spare_at = 26, checksum_at = 28;
static_assert(checksum_at + 1 == message_size);

constexpr std::uint8_t byte(std::string_view bytes, std::size_t at) noexcept {
  return static_cast<std::uint8_t>(bytes[at]);
}

constexpr std::uint32_t unsigned_24(std::string_view bytes, std::size_t at) noexcept {
  return static_cast<std::uint32_t>(byte(bytes, at) << 16U | byte(bytes, at + 1) << 8U | byte(bytes, at + 2));
}

constexpr std::int32_t signed_24(std::string_view bytes, std::size_t at) noexcept {
  const auto number = static_cast<std::int32_t>(unsigned_24(bytes, at));
  return number > most ? number - most_count - 1 : number;
}

std::uint8_t checksum(std::string_view bytes) noexcept {
  unsigned sum = 0x40;
  for (std::size_t i = 0; i < checksum_at; ++i) sum -= byte(bytes, i);
  return static_cast<std::uint8_t>(sum);
}

std::string hexadecimal(std::uint8_t value) {
  constexpr char digits[] = "0123456789ABCDEF";
  return {digits[value >> 4U], digits[value & 15U]};
}

const char* name_of(Field field) noexcept {
  switch (field) {
    case Field::pan:
      return "pan";
    case Field::tilt:
      return "tilt";
    case Field::roll:
      return "roll";
    case Field::x:
      return "x";
    case Field::y:
      return "y";
    case Field::z:
      return "z";
    case Field::zoom:
      return "zoom";
    case Field::focus:
      return "focus";
  }
  return "";
}

std::string describe_range(const Fault& fault) {
  const auto field = static_cast<Field>(fault.code());
  const char* const allowed = field <= Field::roll ? "-256 to 255.99997 degrees"
                              : field <= Field::z  ? "-131.072 to 131.07198 m"
                                                   : "0 to 16777215 as the profile counts";
  return std::string(name_of(field)) + " does not fit the message: allowed are " + allowed;
}

}  // namespace

Fault wrong_size() noexcept {
  return {"wrong size", [](const Fault&) { return std::string("not the 29 bytes of a Free-D message D1"); }, 0, -1};
}

Fault other_message(std::uint8_t type) noexcept {
  if (type < first_type || type > last_type) {
    return {"not Free-D",
            [](const Fault& fault) {
              return "begins with " + hexadecimal(fault.code()) + " and not with D1, as a Free-D message D1 does";
            },
            type, -1};
  }
  return {"other Free-D message",
          [](const Fault& fault) {
            return "Free-D message " + hexadecimal(fault.code()) + ", which has no camera position: ignored";
          },
          type, -1};
}

Fault wrong_checksum() noexcept {
  return {"wrong checksum",
          [](const Fault&) { return std::string("the checksum is wrong (checksum=lenient accepts such messages)"); }, 0,
          -1};
}

Fault no_camera_number() noexcept {
  return {"no camera number",
          [](const Fault&) {
            return std::string(
                "Free-D needs a camera number from 1 to 255: the id of the record is out of this range or not "
                "given; set id=N for the sink");
          },
          0, -1};
}

Fault out_of_range(Field field) noexcept {
  return {"out of range", describe_range, static_cast<std::uint8_t>(field), -1};
}

Fault beyond_lens_table() noexcept {
  return {
      "beyond the lens table",
      [](const Fault&) { return std::string("the focal length or the focus distance is outside of the lens table"); },
      0, -1};
}

Fault no_camera(camera::CameraReason reason) noexcept {
  return {"no camera",
          [](const Fault& fault) { return camera::describe(static_cast<camera::CameraReason>(fault.code())); },
          static_cast<std::uint8_t>(reason), -1};
}

bool claims(std::string_view datagram) noexcept {
  return datagram.size() >= message_size && byte(datagram, 0) >= first_type && byte(datagram, 0) <= last_type;
}

tl::expected<Read, Fault> read(std::string_view datagram) noexcept {
  if (datagram.empty()) return tl::make_unexpected(wrong_size());
  if (byte(datagram, 0) != position_type) return tl::make_unexpected(other_message(byte(datagram, 0)));
  if (datagram.size() != message_size) return tl::make_unexpected(wrong_size());
  Read read;
  Message& m = read.message;
  m.camera = byte(datagram, camera_at);
  m.pan = signed_24(datagram, pan_at);
  m.tilt = signed_24(datagram, tilt_at);
  m.roll = signed_24(datagram, roll_at);
  m.x = signed_24(datagram, x_at);
  m.y = signed_24(datagram, y_at);
  m.z = signed_24(datagram, z_at);
  m.zoom = unsigned_24(datagram, zoom_at);
  m.focus = unsigned_24(datagram, focus_at);
  m.spare = static_cast<std::uint16_t>(byte(datagram, spare_at) << 8U | byte(datagram, spare_at + 1));
  read.checksum_fits = byte(datagram, checksum_at) == checksum(datagram);
  return read;
}

Bytes bytes_of(const Message& m) noexcept {
  Bytes bytes{};
  const auto put = [&bytes](std::size_t at, std::uint32_t number, unsigned size) {
    for (unsigned i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(number >> 8U * (size - 1 - i) & 0xFFU);
  };
  put(0, position_type, 1);
  put(camera_at, m.camera, 1);
  put(pan_at, static_cast<std::uint32_t>(m.pan), 3);
  put(tilt_at, static_cast<std::uint32_t>(m.tilt), 3);
  put(roll_at, static_cast<std::uint32_t>(m.roll), 3);
  put(x_at, static_cast<std::uint32_t>(m.x), 3);
  put(y_at, static_cast<std::uint32_t>(m.y), 3);
  put(z_at, static_cast<std::uint32_t>(m.z), 3);
  put(zoom_at, m.zoom, 3);
  put(focus_at, m.focus, 3);
  put(spare_at, m.spare, 2);
  put(checksum_at, checksum({bytes.data(), bytes.size()}), 1);
  return bytes;
}

}  // namespace trk_bridge::freed
