// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_struct.h"

#include <cstring>
#include <string_view>

#include "handles.h"
#include "records.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::c_api {
namespace {

/// Returns the length; the text must fit into trkStringSize.
int put(std::string_view text, char* buffer) noexcept {
  std::memcpy(buffer, text.data(), text.size());
  buffer[text.size()] = '\0';
  return static_cast<int>(text.size());
}

template <typename Record>
int record_to_string(const Record* record, char* buffer) noexcept {
  if (buffer == nullptr) return 0;
  wire::Buffer text;
  static_assert(sizeof text <= trkStringSize);  // no record has a text of this size
  if (record == nullptr) return put("", buffer);
  const auto written = wire::to_text(from_c(*record), text);
  return put(written ? *written : "", buffer);
}

/// As `guarded`, for functions that return 1 if the text is valid.
template <typename Call>
int understood(Call&& call) noexcept {
  return guarded([&] { return call() ? trkOK : trkFailed; }) == trkOK ? 1 : 0;
}

}  // namespace
}  // namespace trk_bridge::c_api

using namespace trk_bridge;

const char* trkErrorMessage(trkError error) {
  switch (error) {
    case trkOK:
      return "OK";
    case trkFailed:
      return "Operation failed !";
    case trkInvalidHandle:
      return "Invalid handle !";
    case trkInvalidVersion:
      return "Invalid version !";
    case trkUnavailable:
      return "Data unavailable !";
  }
  return "Unknown error !";
}

int trkParamsToString(const trkCameraParams* params, char* buffer) { return c_api::record_to_string(params, buffer); }

int trkConstantsToString(const trkCameraConstants* constants, char* buffer) {
  return c_api::record_to_string(constants, buffer);
}

int trkStringToParams(const char* string, trkCameraParams* params) {
  if (string == nullptr || params == nullptr) return 0;
  const auto read = wire::params_from_text(string);
  if (read) *params = c_api::to_c(*read);
  return read ? 1 : 0;
}

int trkStringToConstants(const char* string, trkCameraConstants* constants) {
  if (string == nullptr || constants == nullptr) return 0;
  const auto read = wire::constants_from_text(string);
  if (read) *constants = c_api::to_c(*read);
  return read ? 1 : 0;
}

int trkFormatToString(unsigned format, char* buffer) {
  if (buffer == nullptr) return 0;
  int length = 0;
  c_api::guarded([&] {
    length = c_api::put(wire::format_to_words(format), buffer);
    return trkOK;
  });
  return length;
}

int trkStringToFormat(const char* string, unsigned* format) {
  if (string == nullptr || format == nullptr) return 0;
  return c_api::understood([&] {
    const auto mask = wire::format_from_words(string);
    if (mask) *format = *mask;
    return mask.has_value();
  });
}
