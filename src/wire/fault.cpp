// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/fault.h"

namespace trk_bridge::wire {

const char* name(Reason reason) noexcept {
  switch (reason) {
    case Reason::too_long:
      return "too long";
    case Reason::truncated:
      return "truncated";
    case Reason::bad_magic:
      return "bad magic";
    case Reason::bad_type:
      return "bad type";
    case Reason::bad_encoding:
      return "bad encoding";
    case Reason::not_a_number:
      return "not a number";
    case Reason::out_of_range:
      return "out of range";
    case Reason::not_finite:
      return "not finite";
    case Reason::trailing_text:
      return "trailing text";
    case Reason::wrong_size:
      return "wrong size";
    case Reason::layout_mismatch:
      return "layout mismatch";
    case Reason::no_valid_layout:
      return "no valid layout";
  }
  return "unknown reason";
}

namespace {

const char* explanation(Reason reason) noexcept {
  switch (reason) {
    case Reason::too_long:
      return "more than 4096 bytes";
    case Reason::truncated:
      return "ends before the record does";
    case Reason::bad_magic:
      return "does not begin with DMC01 and a NUL";
    case Reason::bad_type:
      return "neither P (parameters) nor C (constants)";
    case Reason::bad_encoding:
      return "neither A (ASCII) nor B (binary)";
    case Reason::not_a_number:
      return "a field is not a number";
    case Reason::out_of_range:
      return "a field does not fit its type";
    case Reason::not_finite:
      return "a field is NaN or infinite";
    case Reason::trailing_text:
      return "more than white space after the last field";
    case Reason::wrong_size:
      return "no known layout has a binary record of this size";
    case Reason::layout_mismatch:
      return "the size is not that of the given layout";
    case Reason::no_valid_layout:
      return "no layout of this size gives a valid record";
  }
  return "no explanation";
}

const char* predicate(Reason reason) noexcept {
  switch (reason) {
    case Reason::truncated:
      return "is missing";
    case Reason::not_a_number:
      return "is not a number";
    case Reason::out_of_range:
      return "does not fit its type";
    case Reason::not_finite:
      return "is not finite";
    default:
      return nullptr;
  }
}

}  // namespace

std::string describe(const Fault& fault) {
  const char* const what = fault.about_field ? predicate(fault.reason) : nullptr;
  if (what == nullptr) return std::string(name(fault.reason)) + ": " + explanation(fault.reason);
  const std::string which = fault.field == 0 ? "the id" : "field " + std::to_string(fault.field);
  return which + ' ' + what;
}

}  // namespace trk_bridge::wire
