// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Encodes records to OpenTrackIO packets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "packet.h"
#include "records.h"
#include "transport/datagram.h"

namespace trk_bridge::opentrackio {

/// One sample for each set of parameters, in as many packets as necessary. Constants become the static part of the next
/// sample. Allocates in the library that writes JSON and CBOR.
class PacketEncoder final : public transport::Encoder {
 public:
  /// `source_id` is a urn:uuid.
  PacketEncoder(const WriterSettings& settings, Encoding encoding, const std::string& source_id);

  void use_time(std::int64_t nanoseconds, const std::optional<base::TimeCodeWithRate>& code) noexcept override {
    nanoseconds_ = nanoseconds;
    code_ = code;
  }
  tl::expected<void, transport::Fault> begin(const wire::CameraParams&) noexcept override;
  tl::expected<void, transport::Fault> begin(const wire::CameraConstants&) noexcept override;
  std::optional<std::string_view> next() noexcept override;

 private:
  RecordsWriter writer_;
  Encoding encoding_;
  Names names_;
  std::uint64_t samples_ = 0;
  std::int64_t nanoseconds_ = 0;
  std::optional<base::TimeCodeWithRate> code_;

  std::string text_;       // of the sample
  std::size_t given_ = 0;  // bytes of it that next() has returned
  bool is_given_ = true;
  std::uint16_t sequence_ = 0;
  PacketBuffer buffer_{};
};

/// A urn:uuid of these bits, marked as custom (RFC 9562, version 8).
std::string uuid(std::uint64_t high, std::uint64_t low);

}  // namespace trk_bridge::opentrackio
