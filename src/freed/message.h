// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The bytes of a Free-D message D1 (camera position and orientation), and faults (doc/free_d.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::freed {

inline constexpr std::size_t message_size = 29;
using Bytes = std::array<char, message_size>;

/// The numbers in the message: z-up; at zero angles, the camera looks along +y; pan is positive to the right, tilt up,
/// roll clockwise seen from behind.
struct Message {
  std::uint8_t camera = 0;
  std::int32_t pan = 0, tilt = 0, roll = 0;  ///< 24 bits, 1/32768 degree
  std::int32_t x = 0, y = 0, z = 0;          ///< 24 bits, 1/64 mm
  std::uint32_t zoom = 0, focus = 0;         ///< 24 bits
  std::uint16_t spare = 0;
};

inline constexpr double per_degree = 32768;
inline constexpr double per_metre = 64000;
inline constexpr std::int32_t least = -0x800000;      ///< of signed 24 bits
inline constexpr std::int32_t most = 0x7FFFFF;        ///< of signed 24 bits
inline constexpr std::int32_t most_count = 0xFFFFFF;  ///< of unsigned 24 bits

/// Numbers of a message, for faults.
enum class Field : std::uint8_t { pan, tilt, roll, x, y, z, zoom, focus };

/// Faults of received bytes that are not a message D1.
transport::Fault wrong_size() noexcept;
/// `type` is the first byte.
transport::Fault other_message(std::uint8_t type) noexcept;
transport::Fault wrong_checksum() noexcept;
/// Faults of records that cannot be written.
transport::Fault no_camera_number() noexcept;  ///< the id is not one of 1 to 255
transport::Fault out_of_range(Field) noexcept;
transport::Fault beyond_lens_table() noexcept;
transport::Fault no_camera(camera::CameraReason) noexcept;

/// Whether a datagram begins like a Free-D message of any type and is long enough for a D1.
bool claims(std::string_view datagram) noexcept;

/// A decoded message, with a right or wrong checksum.
struct Read {
  Message message;
  bool checksum_fits = true;
};
[[nodiscard]] tl::expected<Read, transport::Fault> read(std::string_view datagram) noexcept;

/// The numbers must fit into 24 bits.
[[nodiscard]] Bytes bytes_of(const Message&) noexcept;

}  // namespace trk_bridge::freed
