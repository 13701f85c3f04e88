// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_mem.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <string_view>

#include "environment.h"
#include "handles.h"
#include "records.h"
#include "shm/link.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::c_api {
namespace {

using shm::Link;
using shm::ReadResult;
using shm::SlotFault;
using shm::SlotProblem;

std::atomic<unsigned> configured{trkMemDefault};

/// The transfer of a handle.
using Memory = Link;

/// The steady clock with a resolution of a few milliseconds, ten times faster.
Link::Clock::time_point coarse_now() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  return Link::Clock::time_point(std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec));
}

/// The layout of new segments. Null, and a line on stderr, if no segment has the layout in the environment.
const shm::SegmentLayout* layout_to_make() {
  const auto choice = layout_from_environment();
  if (!choice) return nullptr;
  const auto* const layout = shm::layout_of(wire::resolve(*choice, shm::default_layout));
  if (layout == nullptr) {
    std::fprintf(
        stderr,
        "libtrk: TRK_LAYOUT=%s: no shared memory has this layout; allowed are document, identified, and either "
        "followed by _lp64 or _i386\n",
        std::getenv("TRK_LAYOUT"));
  }
  return layout;
}

trkError error_of(const SlotFault& fault) noexcept {
  if (fault.problem == SlotProblem::foreign) return trkInvalidVersion;
  return trkFailed;
}

trkError error_of(ReadResult result) noexcept {
  return result == ReadResult::fresh ? trkOK : result == ReadResult::malformed ? trkInvalidVersion : trkUnavailable;
}

ReadResult read_new(Memory& memory, trkCameraConstants& into) noexcept {
  wire::CameraConstants constants;
  transport::Fault fault;
  const ReadResult result = memory.read(constants, fault);
  if (result == ReadResult::fresh) into = to_c(constants);
  return result;
}

/// Whether the records of the segment have the layout of the structures of this program.
bool is_native(const Memory& memory) noexcept {
  return has_native_params && memory.segment()->layout().record == shm::default_layout;
}

ReadResult read_fresh(Memory& memory, trkCameraParams& into) noexcept {
  NativeParams native;
  if (is_native(memory) && memory.read_known_params(native)) {
    if (!is_finite(native, format_of(native))) return ReadResult::malformed;
    from_native(native, into);
    return ReadResult::fresh;
  }
  wire::CameraParams params;
  transport::Fault fault;
  const ReadResult result = memory.read(params, fault);
  if (result == ReadResult::fresh) into = to_c(params);
  return result;
}

// Programs call this far more often than there are new records.
inline ReadResult read_new(Memory& memory, trkCameraParams& into) noexcept {
  return memory.has_new_params() ? read_fresh(memory, into) : ReadResult::nothing;
}

template <typename CRecord>
trkError read(trkHandle handle, CRecord* into) {
  return guarded([&] {
    return handles<Memory>().with(handle, [&](Memory& memory) {
      if (into == nullptr) return trkFailed;
      if (const auto kept = memory.keep(coarse_now()); !kept) {
        return shm::is_absence(kept.error().problem) ? trkUnavailable : error_of(kept.error());
      }
      return error_of(read_new(memory, *into));
    });
  });
}

bool put(Memory& memory, const trkCameraConstants& constants) noexcept {
  return memory.write(from_c(constants)).has_value();
}

bool put(Memory& memory, const trkCameraParams& params) noexcept {
  if (!is_native(memory)) return memory.write(from_c(params)).has_value();
  const WordsOf words{params};
  if (!is_finite(words, params.format)) return false;
  if (wire::has(params.format, wire::euler)) {
    memory.write_params<native_words>([&](std::size_t i) { return is_beyond_euler(i) ? 0 : words[i]; });
  } else {
    memory.write_params<native_words>([&](std::size_t i) { return words[i]; });
  }
  return true;
}

template <typename CRecord>
trkError write(trkHandle handle, const CRecord* record) {
  return guarded([&] {
    return handles<Memory>().with(handle, [&](Memory& memory) {
      if (!is_writable(record)) return trkFailed;
      if (const auto kept = memory.keep_for_writing(coarse_now()); !kept) return error_of(kept.error());
      if (!memory.segment()->writable()) return trkFailed;
      return put(memory, *record) ? trkOK : trkFailed;
    });
  });
}

void close_at_exit() {
  handles<Memory>().close_all_at_exit([](Memory&) { return trkOK; });
}

}  // namespace
}  // namespace trk_bridge::c_api

using namespace trk_bridge;
using c_api::guarded;
using c_api::handles;
using c_api::Memory;

void trkMemConfigure(unsigned flags) { c_api::configured = flags; }

trkError trkMemOpen(int slot, trkHandle* handle) {
  return guarded([&] {
    if (handle == nullptr || slot < 0 || slot >= shm::slot_count) return trkFailed;
    Memory::Options options;
    options.slot = slot;
    options.create = c_api::layout_to_make();
    options.checks_every_write = false;
    options.recreate = (c_api::configured.load() & trkMemRecreate) != 0;
    if (options.create == nullptr) return trkFailed;
    Memory memory(options);
    if (const auto opened = memory.open_for_writing(); !opened) return c_api::error_of(opened.error());
    static std::once_flag registered;
    std::call_once(registered, [] { std::atexit(c_api::close_at_exit); });
    *handle = handles<Memory>().open(std::move(memory));
    return trkOK;
  });
}

trkError trkMemClose(trkHandle handle) {
  return guarded([&] {
    // It detaches when it is destroyed.
    return handles<Memory>().close(handle, [](Memory&) { return trkOK; });
  });
}

void trkMemCloseAll(void) {
  guarded([] {
    for (const trkHandle handle : handles<Memory>().all()) trkMemClose(handle);
    return trkOK;
  });
}

trkError trkMemReadParams(trkHandle handle, trkCameraParams* params) { return c_api::read(handle, params); }

trkError trkMemReadConstants(trkHandle handle, trkCameraConstants* constants) { return c_api::read(handle, constants); }

trkError trkMemWriteParams(trkHandle handle, const trkCameraParams* params) { return c_api::write(handle, params); }

trkError trkMemWriteConstants(trkHandle handle, const trkCameraConstants* constants) {
  return c_api::write(handle, constants);
}
