// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_file.h"

#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>

#include "file/take.h"
#include "file/take_writer.h"
#include "handles.h"
#include "records.h"

namespace trk_bridge::c_api {
namespace {

/// Malformed lines are reported and do not end it.
using Playback = std::unique_ptr<file::TakeReader>;

using Recording = std::unique_ptr<file::TakeWriter>;

/// Files that a program has not closed get their final names, as with buffered files.
void close_recordings() {
  handles<Recording>().close_all_at_exit([](Recording& recording) { return recording->close() ? trkOK : trkFailed; });
}

}  // namespace
}  // namespace trk_bridge::c_api

using namespace trk_bridge;
using c_api::guarded;
using c_api::handles;
using c_api::Playback;
using c_api::Recording;

trkError trkFileOpenRead(const char* fileName, char* timeCode, trkCameraConstants* constants, trkHandle* handle) {
  return guarded([&] {
    if (fileName == nullptr || timeCode == nullptr || constants == nullptr || handle == nullptr) return trkFailed;
    // Throws when it cannot be read.
    auto playback =
        std::make_unique<file::TakeReader>(fileName, file::MalformedLines::are_skipped, file::Waiting::blocks);
    if (playback->next() != file::TakeReader::Got::head) return trkInvalidVersion;
    const std::string code = base::to_string(playback->time_code());
    if (code.size() >= trkTimeCodeSize) return trkInvalidVersion;
    const trkCameraConstants read = c_api::to_c(playback->constants());
    *handle = handles<Playback>().open(std::move(playback));
    std::memcpy(timeCode, code.c_str(), code.size() + 1);
    *constants = read;
    return trkOK;
  });
}

trkError trkFileOpenWrite(const char* fileName, const char* timeCode, const trkCameraConstants* constants,
                          trkHandle* handle) {
  return guarded([&] {
    if (fileName == nullptr || timeCode == nullptr || constants == nullptr || handle == nullptr) return trkFailed;
    const auto code = base::parse_time_code(timeCode);
    if (!code) return trkFailed;
    auto recording = std::make_unique<file::TakeWriter>(fileName, *code, /*overwrite=*/true);
    // If it has no constants, it is deleted.
    if (!recording->write(c_api::from_c(*constants))) return trkFailed;
    static std::once_flag registered;
    std::call_once(registered, [] { std::atexit(c_api::close_recordings); });
    *handle = handles<Recording>().open(std::move(recording));
    return trkOK;
  });
}

trkError trkFileClose(trkHandle handle) {
  return guarded([&] {
    const trkError closed = handles<Playback>().close(handle, [](Playback&) { return trkOK; });
    if (closed != trkInvalidHandle) return closed;
    return handles<Recording>().close(handle,
                                      [](Recording& recording) { return recording->close() ? trkOK : trkFailed; });
  });
}

trkError trkFileReadParams(trkHandle handle, trkCameraParams* params) {
  return guarded([&] {
    return handles<Playback>().with(handle, [&](Playback& playback) {
      if (params == nullptr) return trkFailed;
      using Got = file::TakeReader::Got;
      switch (playback->next()) {
        case Got::params:
          *params = c_api::to_c(playback->params());
          return trkOK;
        case Got::skipped:
          return trkInvalidVersion;
        case Got::failed:
          return trkFailed;
        default:
          return trkUnavailable;
      }
    });
  });
}

trkError trkFileWriteParams(trkHandle handle, const trkCameraParams* params) {
  return guarded([&] {
    return handles<Recording>().with(handle, [&](Recording& recording) {
      if (!c_api::is_writable(params)) return trkFailed;
      return recording->write(c_api::from_c(*params)) ? trkOK : trkFailed;
    });
  });
}
