#include <trk/trk_file.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>

#include <sys/stat.h>
#include <unistd.h>

#include "file/take.h"
#include "handles.h"
#include "records.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::c_api {
namespace {

struct Playback {
  file::Take take;
  std::size_t next = 0;
};

using Recording = std::unique_ptr<file::TakeWriter>;

bool can_be_read(const char* file_name) noexcept {
  struct stat state {};
  return ::stat(file_name, &state) == 0 && !S_ISDIR(state.st_mode) && ::access(file_name, R_OK) == 0;
}

/// What a program leaves open is brought to its place, as buffered files are.
void close_recordings() {
  guarded([] {
    for (const trkHandle handle : handles<Recording>().all()) trkFileClose(handle);
    return trkOK;
  });
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
    if (!c_api::can_be_read(fileName)) return trkFailed;
    Playback playback;
    try {
      playback.take = file::read_take(fileName);
    } catch (const transport::TransportError&) {
      return trkInvalidVersion;
    }
    const std::string code = base::to_string(playback.take.time_code);
    if (code.size() >= trkTimeCodeSize) return trkInvalidVersion;
    const trkCameraConstants read = c_api::to_c(playback.take.constants);
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
    auto recording = std::make_unique<file::TakeWriter>(fileName, *code, true);
    // Without constants nothing stays of it.
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
      if (playback.next == playback.take.params.size()) return trkUnavailable;
      *params = c_api::to_c(playback.take.params[playback.next++]);
      return trkOK;
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
