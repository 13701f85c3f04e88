#include <trk/trk_mem.h>

#include <atomic>
#include <cstdlib>
#include <mutex>

#include "handles.h"
#include "records.h"
#include "shm/link.h"

namespace trk_bridge::c_api {
namespace {

using shm::Link;
using shm::ReadResult;
using shm::SlotFault;
using shm::SlotProblem;

std::atomic<unsigned> configured{trkMemDefault};

/// What a handle stands for.
using Memory = Link;

Link::Options options_for(int slot) {
  // The field's own programs on a 64-bit machine make and find the same.
  constexpr std::size_t document_lp64 = 528;
  Link::Options options;
  options.slot = slot;
  options.create = shm::layout_of_size(document_lp64);
  options.recreate = (configured.load() & trkMemRecreate) != 0;
  return options;
}

trkError error_of(const SlotFault& fault) noexcept {
  if (fault.problem == SlotProblem::foreign) return trkInvalidVersion;
  return trkFailed;
}

template <typename CRecord, typename Record>
trkError read(trkHandle handle, CRecord* into) {
  return guarded([&] {
    return handles<Memory>().with(handle, [&](Memory& memory) {
      if (into == nullptr) return trkFailed;
      if (const auto kept = memory.keep(Link::Clock::now()); !kept) {
        return shm::is_absence(kept.error().problem) ? trkUnavailable : error_of(kept.error());
      }
      Record record;
      wire::Fault fault{};
      switch (memory.read(record, fault)) {
        case ReadResult::fresh:
          *into = to_c(record);
          return trkOK;
        case ReadResult::malformed:
          return trkInvalidVersion;
        case ReadResult::nothing:
          break;
      }
      return trkUnavailable;
    });
  });
}

template <typename CRecord>
trkError write(trkHandle handle, const CRecord* record) {
  return guarded([&] {
    return handles<Memory>().with(handle, [&](Memory& memory) {
      if (!is_writable(record)) return trkFailed;
      if (const auto kept = memory.keep_for_writing(Link::Clock::now()); !kept) return error_of(kept.error());
      if (!memory.segment()->writable()) return trkFailed;
      return memory.write(from_c(*record)) ? trkOK : trkFailed;
    });
  });
}

}  // namespace
}  // namespace trk_bridge::c_api

using namespace trk_bridge;
using c_api::guarded;
using c_api::handles;
using c_api::Memory;

trkError trkMemConfigure(unsigned flags) {
  constexpr unsigned kinds = unsigned{trkMemSysV} | unsigned{trkMemArena};
  if ((flags & ~(kinds | unsigned{trkMemRecreate})) != 0 || (flags & kinds) == kinds) return trkFailed;
  c_api::configured = flags;
  return trkOK;
}

trkError trkMemOpen(int slot, trkHandle* handle) {
  return guarded([&] {
    if (handle == nullptr || slot < 0 || slot >= shm::slot_count) return trkFailed;
    Memory memory(c_api::options_for(slot));
    if (const auto open = memory.keep_for_writing(Memory::Clock::now()); !open) return c_api::error_of(open.error());
    static std::once_flag registered;
    std::call_once(registered, [] { std::atexit(trkMemCloseAll); });
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

trkError trkMemReadParams(trkHandle handle, trkCameraParams* params) {
  return c_api::read<trkCameraParams, wire::CameraParams>(handle, params);
}

trkError trkMemReadConstants(trkHandle handle, trkCameraConstants* constants) {
  return c_api::read<trkCameraConstants, wire::CameraConstants>(handle, constants);
}

trkError trkMemWriteParams(trkHandle handle, const trkCameraParams* params) { return c_api::write(handle, params); }

trkError trkMemWriteConstants(trkHandle handle, const trkCameraConstants* constants) {
  return c_api::write(handle, constants);
}
