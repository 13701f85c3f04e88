// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Faults of packets, samples, and records to be sent.
#pragma once

#include <cstdint>
#include <string>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::opentrackio {

enum class Reason : std::uint8_t {
  truncated,         ///< shorter than its header
  bad_magic,         ///< does not begin with OTrk
  bad_encoding,      ///< neither JSON nor CBOR
  wrong_length,      ///< not as long as its header says
  wrong_checksum,    ///< the bytes were changed on the way
  lost_segment,      ///< a segment is missing: the complete sample is discarded
  too_long,          ///< a sample of more than most_bytes
  not_json,          ///< the text is not what the header says
  not_cbor,          ///< the bytes are not what the header says
  too_deep,          ///< nested deeper than most_depth
  wrong_type,        ///< of a member
  out_of_range,      ///< of a member
  missing,           ///< a member without which others are meaningless
  source_number,     ///< 0, above 200 or missing
  empty_sample,      ///< neither a transform nor a sensor
  unknown_model,     ///< unknown distortion model
  sensor_needed,     ///< the distortion must be fitted, and the size of the sensor is unknown
  no_fit,            ///< the distortion cannot be approximated by k1 and k2
  no_source_number,  ///< writing: the id is not a source number, and source=N is not given
};

/// `member` is an opentrackio::Id or a field; negative: none.
transport::Fault fault_of(Reason, int member = -1) noexcept;
/// For a record that is not a valid camera.
transport::Fault fault_of(camera::CameraReason) noexcept;

}  // namespace trk_bridge::opentrackio
