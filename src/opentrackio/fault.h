// What is wrong with a packet, a sample, or a record that is to become one.
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
  wrong_checksum,    ///< the bytes are not those that were sent
  lost_segment,      ///< a sample of several segments lacks one: it is discarded whole
  too_long,          ///< a sample of more than most_bytes
  not_json,          ///< the text is not what the header says
  not_cbor,          ///< likewise
  too_deep,          ///< nested deeper than samples are
  wrong_type,        ///< of a member
  out_of_range,      ///< of a member
  missing,           ///< a member, without which others mean nothing
  source_number,     ///< 0, above 200 or not there
  nothing_in_it,     ///< neither a transform nor a sensor
  unknown_model,     ///< of distortion
  sensor_needed,     ///< the distortion has to be fitted, and the sensor's size is not known
  no_fit,            ///< no k1 and k2 come near the distortion
  no_source_number,  ///< writing: the id is none, and no source=N is given
};

/// `member` is of opentrackio::Id or a field; negative: none.
transport::Fault fault_of(Reason, int member = -1) noexcept;
/// Why a record is no camera.
transport::Fault fault_of(camera::CameraReason) noexcept;

}  // namespace trk_bridge::opentrackio
