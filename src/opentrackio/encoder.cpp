// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "encoder.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <random>

namespace trk_bridge::opentrackio {

std::string uuid(std::uint64_t high, std::uint64_t low) {
  high = (high & ~std::uint64_t{0xF000}) | 0x8000U;
  low = (low & (~std::uint64_t{0} >> 2U)) | std::uint64_t{1} << 63U;
  char text[64];
  std::snprintf(text, sizeof text, "urn:uuid:%08" PRIx64 "-%04" PRIx64 "-%04" PRIx64 "-%04" PRIx64 "-%012" PRIx64,
                high >> 32U, high >> 16U & 0xFFFFU, high & 0xFFFFU, low >> 48U, low & 0xFFFFFFFFFFFFU);
  return text;
}

PacketEncoder::PacketEncoder(const WriterSettings& settings, Encoding encoding, const std::string& source_id)
    : writer_(settings), encoding_(encoding) {
  names_.source_id = source_id;
  // A random start, so that sample ids differ between runs.
  samples_ = std::uint64_t{std::random_device{}()} << 32U;
}

tl::expected<void, transport::Fault> PacketEncoder::begin(const wire::CameraConstants& constants) noexcept {
  is_given_ = true;
  return writer_.use(constants);
}

tl::expected<void, transport::Fault> PacketEncoder::begin(const wire::CameraParams& params) noexcept {
  is_given_ = true;
  const auto sample = writer_.sample_of(params, nanoseconds_, code_);
  if (!sample) return tl::unexpected(sample.error());
  names_.sample_id = uuid(std::hash<std::string>{}(names_.source_id), ++samples_);
  names_.label = "camera " + std::to_string(params.id);
  write(*sample, names_, encoding_, text_);
  given_ = 0;
  is_given_ = false;
  return {};
}

std::optional<std::string_view> PacketEncoder::next() noexcept {
  if (is_given_) return std::nullopt;
  Packet packet;
  packet.encoding = encoding_;
  packet.sequence = sequence_++;
  packet.offset = static_cast<std::uint32_t>(given_);
  packet.payload = std::string_view(text_).substr(given_, most_payload);
  given_ += packet.payload.size();
  packet.is_last = is_given_ = given_ == text_.size();
  return write(packet, buffer_);
}

}  // namespace trk_bridge::opentrackio
