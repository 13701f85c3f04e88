// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Decodes Free-D datagrams to samples.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "lens/table.h"
#include "message.h"
#include "profile.h"
#include "transport/datagram.h"

namespace trk_bridge::freed {

/// How messages are interpreted.
struct DecoderOptions {
  Profile profile = Profile::generic;
  std::shared_ptr<const lens::Table> table;  ///< null: encoder counts have no meaning
  bool lenient = false;                      ///< a wrong checksum is a Sample::doubt and not a fault
};

/// One sample per datagram, with Euler angles and image distance and a running number as its counter. It has a lens if
/// the table or the profile gives one. Before the first sample of a camera, and before every `constants_every`-th, the
/// constants of the table are returned, if it has any.
class Decoder final : public transport::Decoder {
 public:
  static constexpr std::uint64_t constants_every = 50;

  explicit Decoder(DecoderOptions options) : options_(std::move(options)) {}

  void begin(std::string_view datagram, const transport::Sender&) noexcept override;
  Next next(transport::Sample& into, transport::Fault& fault) noexcept override;

 private:
  enum class State : std::uint8_t { done, begun, constants_given };

  bool constants_are_due() const noexcept;
  void fill(transport::Sample& into) const noexcept;

  const DecoderOptions options_;
  std::string_view datagram_;
  State state_ = State::done;
  Read read_;
  std::array<std::uint64_t, 256> messages_{};  // received messages by camera
};

}  // namespace trk_bridge::freed
