#include <trk/trk_struct.h>

#include <cstring>
#include <string_view>

#include "handles.h"
#include "records.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::c_api {
namespace {

trkError put(std::string_view text, char* buffer, size_t size) noexcept {
  if (text.size() >= size) return trkFailed;
  std::memcpy(buffer, text.data(), text.size());
  buffer[text.size()] = '\0';
  return trkOK;
}

template <typename Record>
trkError record_to_string(const Record* record, char* buffer, size_t size) noexcept {
  if (buffer == nullptr || size == 0) return trkFailed;
  buffer[0] = '\0';
  if (record == nullptr) return trkFailed;
  wire::Buffer text;
  const auto written = wire::to_text(from_c(*record), text);
  return written ? put(*written, buffer, size) : trkFailed;
}

}  // namespace
}  // namespace trk_bridge::c_api

using namespace trk_bridge;

const char* trkErrorMessage(trkError error) {
  switch (error) {
    case trkOK:
      return "completed successfully";
    case trkFailed:
      return "failed";
    case trkInvalidHandle:
      return "invalid handle";
    case trkInvalidVersion:
      return "data of an invalid format";
    case trkUnavailable:
      return "no new data available";
  }
  return "unknown error";
}

trkError trkParamsToString(const trkCameraParams* params, char* buffer, size_t size) {
  return c_api::record_to_string(params, buffer, size);
}

trkError trkConstantsToString(const trkCameraConstants* constants, char* buffer, size_t size) {
  return c_api::record_to_string(constants, buffer, size);
}

trkError trkStringToParams(const char* string, trkCameraParams* params) {
  if (string == nullptr || params == nullptr) return trkFailed;
  const auto read = wire::params_from_text(string);
  if (!read) return trkInvalidVersion;
  *params = c_api::to_c(*read);
  return trkOK;
}

trkError trkStringToConstants(const char* string, trkCameraConstants* constants) {
  if (string == nullptr || constants == nullptr) return trkFailed;
  const auto read = wire::constants_from_text(string);
  if (!read) return trkInvalidVersion;
  *constants = c_api::to_c(*read);
  return trkOK;
}

trkError trkFormatToString(unsigned format, char* buffer, size_t size) {
  return c_api::guarded([&] {
    if (buffer == nullptr || size == 0) return trkFailed;
    buffer[0] = '\0';
    return c_api::put(wire::format_to_words(format), buffer, size);
  });
}

trkError trkStringToFormat(const char* string, unsigned* format) {
  return c_api::guarded([&] {
    if (string == nullptr || format == nullptr) return trkFailed;
    const auto mask = wire::format_from_words(string);
    if (!mask) return trkFailed;
    *format = *mask;
    return trkOK;
  });
}
