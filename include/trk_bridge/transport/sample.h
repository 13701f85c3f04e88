// A record with where, when and how it came, and why bytes are not one.
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

/// An address and port, a slot, or what else a record comes from.
struct Sender {
  SenderKind kind = SenderKind::none;
  std::array<std::uint8_t, 16> address{};  ///< network byte order; IPv4 in the first four, mapped IPv4 counts as IPv4
  std::uint32_t number = 0;                ///< port, slot
};

inline bool operator==(const Sender& a, const Sender& b) noexcept {
  // Of a size that the compiler knows, and so without a call.
  return a.kind == b.kind && a.number == b.number &&
         std::memcmp(a.address.data(), b.address.data(), sizeof a.address) == 0;
}
inline bool operator!=(const Sender& a, const Sender& b) noexcept { return !(a == b); }

/// "192.0.2.7:50123", "[fe80::1]:50123", "slot 7", "file", "memory", "-".
std::string to_string(const Sender&);

/// Trivially copyable, never allocates. Each protocol makes its own faults; trk's are made from wire::Fault.
class Fault {
 public:
  /// The line for a person; called only when somebody reads the fault.
  using Describe = std::string (*)(const Fault&);

  /// No fault.
  Fault() noexcept = default;
  /// `name` is a short static text, for counting by reason. `code` and `field` are for `describe`; what they mean is
  /// the protocol's matter.
  Fault(const char* name, Describe describe, std::uint8_t code, std::int16_t field, std::uint32_t line = 0) noexcept
      : name_(name), describe_(describe), code_(code), field_(field), line_(line) {}
  /// A fault of trk.
  Fault(const wire::Fault&) noexcept;  // NOLINT(google-explicit-constructor): it is the same fault

  /// "bad magic"; "none" when there is no fault.
  const char* name() const noexcept { return name_; }
  std::uint8_t code() const noexcept { return code_; }
  /// Which field it is about; negative when it is about none.
  std::int16_t field() const noexcept { return field_; }
  /// The line of a file, from 1; 0 where there are no lines.
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

/// What a lens's encoders count, where a protocol tells that. What a count means is the lens's matter (lens/table.h).
struct LensEncoders {
  std::optional<std::int32_t> zoom, focus, iris;  ///< none: not told
};
constexpr bool operator==(const LensEncoders& a, const LensEncoders& b) noexcept {
  return a.zoom == b.zoom && a.focus == b.focus && a.iris == b.iris;
}
constexpr bool operator!=(const LensEncoders& a, const LensEncoders& b) noexcept { return !(a == b); }

/// What sources hand out. Copying allocates nothing.
struct Sample {
  wire::Record record;
  std::int64_t arrival = 0;  ///< ns since 1970 UTC: the kernel's receive time for datagrams; for files see the source
  Sender sender;
  const char* origin = "";  ///< how it was encoded, for a person; static text: "ASCII", "binary identified_lp64"

  /// False where the protocol has no counter: then the record's is a number of its own, which says nothing of what was
  /// lost.
  bool has_counter = true;
  /// False where the protocol has no lens: then of the record's parameters only the pose says anything.
  bool has_lens = true;
  LensEncoders encoders;  ///< empty where the protocol has none
  /// Why it may be wrong although it was accepted: "wrong checksum". Static text for people; empty: no doubt.
  const char* doubt = "";
  /// When the sender sampled the camera by its own clock, ns since 1970 UTC; none where the protocol has no time.
  std::optional<std::int64_t> sample_time;
  std::optional<base::CountedTimeCode> time_code;  ///< none where the protocol has none
};

/// "ASCII", "binary identified_lp64", "binary document_i386_be", with ", layout guessed" behind it where two layouts
/// would have done. Static text.
const char* origin_of(const wire::WireForm&, bool layout_guessed = false) noexcept;

}  // namespace trk_bridge::transport
