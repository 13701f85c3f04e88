// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A sample of OpenTrackIO: the members that trk can express, and their encoding in JSON and CBOR.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

#include "fault.h"
#include "trk_bridge/wire/fields.h"

namespace trk_bridge::opentrackio {

/// As in the header of a packet.
enum class Encoding : std::uint8_t { json = 1, cbor = 2 };

/// Members that are read or written; all others are skipped. `x`, `radial` and similar names are children of the
/// preceding member with children.
enum class Id : std::uint8_t {
  root,
  source_number,
  timing,
  sequence_number,
  timestamp,
  timestamp_seconds,
  timestamp_nanoseconds,
  sample_rate,
  sample_rate_num,
  sample_rate_denom,
  timecode,
  hours,
  minutes,
  seconds,
  frames,
  sub_frame,
  drop_frame,
  frame_rate,
  frame_rate_num,
  frame_rate_denom,
  lens,
  focal_length,
  focus_distance,
  f_stop,
  projection_offset,
  projection_x,
  projection_y,
  distortion_offset,
  distortion_x,
  distortion_y,
  distortions,
  distortion,
  model,
  radial,
  tangential,
  transforms,
  transform,
  translation,
  x,
  y,
  z,
  rotation,
  pan,
  tilt,
  roll,
  scale,
  scale_x,
  scale_y,
  scale_z,
  statics,
  camera,
  sensor,
  sensor_width,
  sensor_height,
  resolution,
  resolution_width,
  resolution_height,
  custom,
  custom_trk,
  custom_params,
  custom_matrix,
  custom_constants,
  fields,  ///< the first field of the records, which follow all other members
};

/// `custom.trk.params` and `custom.trk.constants` have members with the names of the fields, in the order of
/// wire/fields.h.
template <typename Record>
constexpr std::size_t first_field() noexcept {
  constexpr auto begin = static_cast<std::size_t>(Id::fields);
  if constexpr (std::is_same_v<Record, wire::CameraParams>) return begin;
  constexpr std::size_t euler = begin + wire::field_count<wire::CameraParams>();
  if constexpr (std::is_same_v<Record, wire::Euler>) return euler;
  return euler + wire::field_count<wire::Euler>();
}
inline constexpr std::size_t member_count =
    first_field<wire::CameraConstants>() + wire::field_count<wire::CameraConstants>();

/// "lens.distortion.radial".
std::string path_of(std::size_t member);

/// The model of the first entry of `lens.distortion`; other entries are ignored.
enum class Model : std::uint8_t {
  distorted_to_undistorted,  ///< "Brown-Conrady D-U", or no name
  undistorted_to_distorted,  ///< "Brown-Conrady U-D"
  other,
};

/// Values of the members, in the units of OpenTrackIO: metres and degrees; the lens in mm, y down.
struct Sample {
  /// The product of all transforms except the last, without their scales.
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
  std::size_t transforms = 0;
  std::uint64_t counter = 0;  ///< custom.trk.params.counter, which may not fit into a double

  std::bitset<member_count> has;
  /// Values of all members that are one number; for `transforms`, those of the last. Flags are 0 or 1.
  std::array<double, member_count> numbers{};
  std::array<double, 6> radial{};  ///< missing ones are 0
  std::array<double, 16> matrix{};

  Model model = Model::distorted_to_undistorted;
  bool is_tangential = false;  ///< a tangential term is not 0
  bool has_matrix = false;
  bool is_scaled = false;  ///< a scale is not 1

  bool has_member(Id id) const noexcept { return has[static_cast<std::size_t>(id)]; }
  double number(Id id) const noexcept { return numbers[static_cast<std::size_t>(id)]; }
  void set(std::size_t member, double value) noexcept {
    has.set(member);
    numbers[member] = value;
  }
  void set(Id id, double value) noexcept { set(static_cast<std::size_t>(id), value); }
};

/// Reads a complete sample. A member of the wrong type or out of range, and text that is not in the given encoding, are
/// faults; then `into` is unspecified. Only the library allocates, for long names.
[[nodiscard]] std::optional<transport::Fault> read(std::string_view text, Encoding encoding, Sample& into) noexcept;

/// Names that are written with a sample.
struct Names {
  std::string source_id, sample_id;  ///< urn:uuid:…
  std::string label;                 ///< of the camera, for users
};
/// Replaces `into` by the written sample. `base` is not written: there is only one transform. Allocates.
void write(const Sample&, const Names&, Encoding encoding, std::string& into);

}  // namespace trk_bridge::opentrackio
