// Why bytes are not a sample, or a record cannot be encoded, in the words of the protocol.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "trk_bridge/wire/fault.h"

namespace trk_bridge::transport {

/// Trivially copyable, never allocates. Each protocol makes its own faults; trk's are made from wire::Fault.
class Fault {
 public:
  /// The line for a person; called only when somebody reads the fault.
  using Describe = std::string (*)(const Fault&);

  /// No fault.
  Fault() noexcept = default;
  /// `name` is a short static text, for counting by reason. `code` and `field` are for `describe`; what they mean is
  /// the protocol's matter.
  Fault(const char* name, Describe describe, std::uint8_t code, std::int16_t field) noexcept
      : name_(name), describe_(describe), code_(code), field_(field) {}
  /// A fault of trk.
  Fault(const wire::Fault&) noexcept;  // NOLINT(google-explicit-constructor): it is the same fault

  /// "bad magic"; "none" when there is no fault.
  const char* name() const noexcept { return name_; }
  std::uint8_t code() const noexcept { return code_; }
  /// Which field it is about; negative when it is about none.
  std::int16_t field() const noexcept { return field_; }

  friend bool operator==(const Fault& a, const Fault& b) noexcept { return a.key() == b.key(); }
  friend bool operator!=(const Fault& a, const Fault& b) noexcept { return !(a == b); }
  friend bool operator<(const Fault& a, const Fault& b) noexcept { return a.key() < b.key(); }
  friend std::string describe(const Fault& fault) { return fault.describe_(fault); }

 private:
  static std::string no_fault(const Fault&) { return "none"; }
  std::tuple<std::uintptr_t, std::uint8_t, std::int16_t> key() const noexcept {
    return {reinterpret_cast<std::uintptr_t>(describe_), code_, field_};
  }

  const char* name_ = "none";
  Describe describe_ = no_fault;
  std::uint8_t code_ = 0;
  std::int16_t field_ = -1;
};

}  // namespace trk_bridge::transport
