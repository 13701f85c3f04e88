// Free-D's datagrams to samples.
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

/// What is not in the messages, and what is made of them.
struct DecoderOptions {
  Profile profile = Profile::generic;
  std::shared_ptr<const lens::Table> table;  ///< null: counts have no meaning
  bool lenient = false;                      ///< a wrong checksum is a doubt and not a fault
};

/// One sample a datagram, of Euler angles and image distance, numbered as they come, with a lens where the table or the
/// profile gives one; and before it, for the first and every `constants_every` of a camera, the constants of the table
/// where it has any.
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
  std::array<std::uint64_t, 256> messages_{};  // by camera: how many have come
};

}  // namespace trk_bridge::freed
