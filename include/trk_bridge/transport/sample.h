// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A received record with its sender, arrival time and encoding; faults.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>

#include "trk_bridge/base/time_code.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/fault.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::transport {

/// What `Sender::number` and `Sender::address` mean.
enum class SenderKind : std::uint8_t { none, ipv4, ipv6, shm, file, memory };

/// An address and port, a slot, or another origin of a record.
struct Sender {
  SenderKind kind = SenderKind::none;
  std::array<std::uint8_t, 16> address{};  ///< network byte order; IPv4 in the first four, mapped IPv4 counts as IPv4
  std::uint32_t number = 0;                ///< port, slot
};

inline bool operator==(const Sender& a, const Sender& b) noexcept {
  // The size is a constant, so that the compiler makes no function call.
  return a.kind == b.kind && a.number == b.number &&
         std::memcmp(a.address.data(), b.address.data(), sizeof a.address) == 0;
}
inline bool operator!=(const Sender& a, const Sender& b) noexcept { return !(a == b); }

/// "192.0.2.7:50123", "[fe80::1]:50123", "slot 7", "file", "memory", "-".
std::string to_string(const Sender&);

/// Trivially copyable, never allocates. Each protocol has its own faults; those of trk are made from wire::Fault.
class Fault {
 public:
  /// The text for users; called only when the fault is shown.
  using Describe = std::string (*)(const Fault&);

  /// No fault.
  Fault() noexcept = default;
  /// `name` is a short static text, for counting by reason. `code` and `field` are for `describe`; each protocol
  /// defines what they mean.
  Fault(const char* name, Describe describe, std::uint8_t code, std::int16_t field, std::uint32_t line = 0) noexcept
      : name_(name), describe_(describe), code_(code), field_(field), line_(line) {}
  /// A fault of trk.
  Fault(const wire::Fault&) noexcept;  // NOLINT(google-explicit-constructor): it is the same fault

  /// "bad magic"; "none" when there is no fault.
  const char* name() const noexcept { return name_; }
  std::uint8_t code() const noexcept { return code_; }
  /// The field that it refers to; negative: none.
  std::int16_t field() const noexcept { return field_; }
  /// The line of a file, from 1; 0 if there are no lines.
  std::uint32_t line() const noexcept { return line_; }

  friend bool operator==(const Fault& a, const Fault& b) noexcept { return a.key() == b.key(); }
  friend bool operator!=(const Fault& a, const Fault& b) noexcept { return !(a == b); }
  friend bool operator<(const Fault& a, const Fault& b) noexcept { return a.key() < b.key(); }
  friend std::string describe(const Fault& fault) { return fault.describe_(fault); }

 private:
  static std::string no_fault(const Fault&) { return "none"; }
  std::tuple<std::uintptr_t, std::uint8_t, std::int16_t, std::uint32_t> key() const noexcept {
    return {reinterpret_cast<std::uintptr_t>(describe_), code_, field_, line_};
  }

  const char* name_ = "none";
  Describe describe_ = no_fault;
  std::uint8_t code_ = 0;
  std::int16_t field_ = -1;
  std::uint32_t line_ = 0;
};

/// Encoder counts of the lens, for protocols that have them. A lens table gives them a meaning (lens/table.h).
struct LensEncoders {
  std::optional<std::int32_t> zoom, focus, iris;  ///< none: not sent
};
constexpr bool operator==(const LensEncoders& a, const LensEncoders& b) noexcept {
  return a.zoom == b.zoom && a.focus == b.focus && a.iris == b.iris;
}
constexpr bool operator!=(const LensEncoders& a, const LensEncoders& b) noexcept { return !(a == b); }

/// What a source returns. Copying allocates nothing.
struct Sample {
  wire::Record record;
  std::int64_t arrival = 0;  ///< ns since 1970 UTC; for datagrams, from the kernel; for files, see the source
  Sender sender;
  const char* origin = "";  ///< its encoding, for users; static text: "ASCII", "binary identified_lp64"

  /// False if the protocol has no counter: then the counter of the record is a running number, which does not show
  /// losses.
  bool has_counter = true;
  /// False if there is no lens: then only the pose of the parameters is valid.
  bool has_lens = true;
  LensEncoders encoders;  ///< empty if the protocol has none
  /// Why it may be wrong although it was accepted: "wrong checksum". Static text for users; empty: no doubt.
  const char* doubt = "";
  /// When the sender sampled the camera, by the clock of the sender, ns since 1970 UTC; none if the protocol has no
  /// time.
  std::optional<std::int64_t> sample_time;
  std::optional<base::TimeCodeWithRate> time_code;  ///< none if the protocol has none
};

/// "ASCII", "binary identified_lp64", "binary document_i386_be", followed by ", layout guessed" if two layouts were
/// possible. Static text.
const char* origin_of(const wire::WireForm&, bool layout_guessed = false) noexcept;

}  // namespace trk_bridge::transport
