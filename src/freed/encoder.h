// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Encodes records to Free-D datagrams.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "lens/table.h"
#include "message.h"
#include "profile.h"
#include "transport/datagram.h"
#include "trk_bridge/camera/converter.h"

namespace trk_bridge::freed {

struct EncoderOptions {
  Profile profile = Profile::generic;
  std::shared_ptr<const lens::Table> table;  ///< null: zoom and focus are 0, unless the profile sends the lens itself
  bool unwrap = true;                        ///< pan continues beyond 180 degrees within the range of the message
};

/// One datagram for parameters of any format, none for constants, which are only stored for formats that need them. The
/// id is the camera number and must be 1 to 255.
class Encoder final : public transport::Encoder {
 public:
  explicit Encoder(EncoderOptions options) : options_(std::move(options)) {}

  tl::expected<void, transport::Fault> begin(const wire::CameraParams&) noexcept override;
  tl::expected<void, transport::Fault> begin(const wire::CameraConstants&) noexcept override;
  std::optional<std::string_view> next() noexcept override;

 private:
  struct Camera {
    camera::Converter converter;
    std::optional<std::int32_t> pan;  // of the previous message
    std::uint64_t frames = 0;
  };

  tl::expected<void, transport::Fault> set_pose(const wire::Euler&, const Camera&, Message&) const noexcept;
  tl::expected<void, transport::Fault> set_optics(const camera::Lens&, Message&) const noexcept;

  const EncoderOptions options_;
  std::array<Camera, 256> cameras_;  // by id
  Bytes bytes_{};
  bool has_datagram_ = false;
};

}  // namespace trk_bridge::freed
