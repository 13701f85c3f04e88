// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "fault.h"

#include "packet.h"
#include "sample.h"

namespace trk_bridge::opentrackio {
namespace {

const char* name(Reason reason) noexcept {
  switch (reason) {
    case Reason::truncated:
      return "truncated";
    case Reason::bad_magic:
      return "bad magic";
    case Reason::bad_encoding:
      return "bad encoding";
    case Reason::wrong_length:
      return "wrong length";
    case Reason::wrong_checksum:
      return "wrong checksum";
    case Reason::lost_segment:
      return "lost segment";
    case Reason::too_long:
      return "too long";
    case Reason::not_json:
      return "not JSON";
    case Reason::not_cbor:
      return "not CBOR";
    case Reason::too_deep:
      return "too deep";
    case Reason::wrong_type:
      return "wrong type";
    case Reason::out_of_range:
      return "out of range";
    case Reason::missing:
      return "missing member";
    case Reason::source_number:
    case Reason::no_source_number:
      return "source number";
    case Reason::empty_sample:
      return "empty sample";
    case Reason::unknown_model:
      return "unknown distortion model";
    case Reason::sensor_needed:
      return "sensor needed";
    case Reason::no_fit:
      return "no fit";
  }
  return "?";
}

std::string text_of(Reason reason, int member) {
  const std::string path = member < 0 ? std::string() : path_of(static_cast<std::size_t>(member));
  switch (reason) {
    case Reason::truncated:
      return "shorter than a header of " + std::to_string(header_size) + " bytes";
    case Reason::bad_magic:
      return "bad magic: does not begin with OTrk";
    case Reason::bad_encoding:
      return "the encoding is neither 1 (JSON) nor 2 (CBOR)";
    case Reason::wrong_length:
      return "the packet is not as long as its header says";
    case Reason::wrong_checksum:
      return "wrong checksum";
    case Reason::lost_segment:
      return "a segment is missing: the complete sample is discarded";
    case Reason::too_long:
      return "a sample of more than " + std::to_string(most_bytes) + " bytes";
    case Reason::not_json:
      return "the header says JSON, but the sample is not JSON";
    case Reason::not_cbor:
      return "the header says CBOR, but the sample is not CBOR";
    case Reason::too_deep:
      return "the sample is nested deeper than " + std::to_string(most_depth) + " levels";
    case Reason::wrong_type:
      return path + " is of the wrong type";
    case Reason::out_of_range:
      return path + " is out of range";
    case Reason::missing:
      return path + " is missing";
    case Reason::source_number:
      return "sourceNumber is missing or not 1 to 200: the standard requires that such samples are discarded "
             "(source=any accepts them)";
    case Reason::empty_sample:
      return "neither transforms nor static.camera with size and resolution of the sensor";
    case Reason::unknown_model:
      return "lens.distortion.model is neither \"Brown-Conrady D-U\" nor \"Brown-Conrady U-D\", or has more terms than "
             "they have: the lens is ignored";
    case Reason::sensor_needed:
      return "lens.distortion must be fitted to k1 and k2, but static.camera has not given the size and resolution of "
             "the sensor: the lens is ignored";
    case Reason::no_fit:
      return "lens.distortion folds within the image, or cannot be approximated by k1 and k2: the lens is ignored";
    case Reason::no_source_number:
      return "the id is not a source number from 1 to 200: set source=N";
  }
  return "?";
}

}  // namespace

transport::Fault fault_of(Reason reason, int member) noexcept {
  const auto describe = [](const transport::Fault& fault) {
    return text_of(static_cast<Reason>(fault.code()), fault.field());
  };
  return {name(reason), describe, static_cast<std::uint8_t>(reason), static_cast<std::int16_t>(member)};
}

transport::Fault fault_of(camera::CameraReason reason) noexcept {
  const auto describe = [](const transport::Fault& fault) {
    return camera::describe(static_cast<camera::CameraReason>(fault.code()));
  };
  return {"no camera", describe, static_cast<std::uint8_t>(reason), -1};
}

}  // namespace trk_bridge::opentrackio
