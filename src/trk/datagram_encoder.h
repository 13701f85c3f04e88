// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Encodes records to trk datagrams.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "transport/datagram.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::trk {

/// One datagram per record.
class DatagramEncoder final : public transport::Encoder {
 public:
  explicit DatagramEncoder(const wire::WireForm& form) : form_(form) {}

  tl::expected<void, transport::Fault> begin(const wire::CameraParams& params) noexcept override {
    return keep(wire::encode(params, form_, buffer_, text_cache_));
  }
  tl::expected<void, transport::Fault> begin(const wire::CameraConstants& constants) noexcept override {
    return keep(wire::encode(constants, form_, buffer_));
  }
  std::optional<std::string_view> next() noexcept override { return std::exchange(datagram_, std::nullopt); }

 private:
  tl::expected<void, transport::Fault> keep(const tl::expected<std::string_view, wire::Fault>& encoded) noexcept {
    datagram_.reset();
    if (!encoded) return tl::make_unexpected(transport::Fault(encoded.error()));
    datagram_ = *encoded;
    return {};
  }

  wire::WireForm form_;
  wire::Buffer buffer_{};
  wire::TextCache text_cache_;
  std::optional<std::string_view> datagram_;
};

}  // namespace trk_bridge::trk
