// Handles of open transfers: numbers, never addresses, so that anything a program passes can be looked up safely.
#pragma once

#include <trk/trk_struct.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace trk_bridge::c_api {

/// No exception leaves the interface.
template <typename Call>
trkError guarded(Call&& call) noexcept {
  try {
    return call();
  } catch (...) {
    return trkFailed;
  }
}

/// A value that no other handle of this process has or had.
inline trkHandle next_handle() noexcept {
  // Far from small integers, which programs pass by mistake.
  static std::atomic<std::uintptr_t> last{0x74726B00};
  return reinterpret_cast<trkHandle>(last.fetch_add(0x10) + 0x10);
}

/// The open transfers of one kind. Any thread; calls on one handle take turns, calls on different ones do not.
template <typename Transfer>
class Handles {
 public:
  template <typename... Arguments>
  trkHandle open(Arguments&&... arguments) {
    auto entry = std::make_shared<Entry>();
    entry->transfer.emplace(std::forward<Arguments>(arguments)...);
    const trkHandle handle = next_handle();
    const std::lock_guard lock(mutex_);
    entries_.emplace(handle, std::move(entry));
    return handle;
  }

  /// `use(transfer)`, or trkInvalidHandle.
  template <typename Use>
  trkError with(trkHandle handle, Use&& use) {
    const auto entry = find(handle);
    if (!entry) return trkInvalidHandle;
    const std::lock_guard turn(entry->turn);
    return entry->transfer ? use(*entry->transfer) : trkInvalidHandle;
  }

  /// `end(transfer)`, after which the handle is invalid.
  template <typename End>
  trkError close(trkHandle handle, End&& end) {
    std::shared_ptr<Entry> entry;
    {
      const std::lock_guard lock(mutex_);
      const auto found = entries_.find(handle);
      if (found == entries_.end()) return trkInvalidHandle;
      entry = std::move(found->second);
      entries_.erase(found);
    }
    const std::lock_guard turn(entry->turn);
    const trkError ended = end(*entry->transfer);
    entry->transfer.reset();
    return ended;
  }

  std::vector<trkHandle> all() const {
    std::vector<trkHandle> handles;
    const std::lock_guard lock(mutex_);
    for (const auto& [handle, entry] : entries_) handles.push_back(handle);
    return handles;
  }

 private:
  struct Entry {
    std::mutex turn;
    std::optional<Transfer> transfer;  // none once it is closed, for a call that waited for its turn
  };

  std::shared_ptr<Entry> find(trkHandle handle) const {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(handle);
    return found == entries_.end() ? nullptr : found->second;
  }

  mutable std::mutex mutex_;
  std::unordered_map<trkHandle, std::shared_ptr<Entry>> entries_;
};

/// The handles of a kind, alive until the process ends: functions registered with atexit use them.
template <typename Transfer>
Handles<Transfer>& handles() {
  static auto* const all = new Handles<Transfer>;
  return *all;
}

}  // namespace trk_bridge::c_api
