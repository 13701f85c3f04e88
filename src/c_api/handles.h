// Handles of open transfers: numbers, never addresses, so that anything a program passes can be looked up safely.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "trk_struct.h"
#include "turn_lock.h"

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

/// A number that no other handle of this process has or had.
inline std::uint64_t next_serial() noexcept {
  // Far from small integers, which programs pass by mistake.
  static std::atomic<std::uint64_t> last{0x74726B};
  return ++last;
}

/// The open transfers of one kind. Any thread; calls on one handle take turns, calls on different ones do not. Finding
/// one takes no lock but its own.
template <typename Transfer>
class Handles {
 public:
  /// Throws std::bad_alloc also where `capacity` are open.
  template <typename... Arguments>
  trkHandle open(Arguments&&... arguments) {
    const std::size_t index = take_place();
    Entry& entry = *entries_[index].load();
    entry.turn.wait();
    entry.transfer.emplace(std::forward<Arguments>(arguments)...);
    entry.handle = reinterpret_cast<trkHandle>(static_cast<std::uintptr_t>(next_serial() << 16U | index << 4U));
    const trkHandle handle = entry.handle;
    entry.turn.unlock();
    return handle;
  }

  /// `use(transfer)`, or trkInvalidHandle. trkFailed in a signal handler that interrupted a call on this handle.
  template <typename Use>
  trkError with(trkHandle handle, Use&& use) {
    Entry* const entry = find(handle);
    if (entry == nullptr) return trkInvalidHandle;
    if (!entry->turn.wait()) return trkFailed;
    const std::lock_guard<TurnLock> unlock(entry->turn, std::adopt_lock);
    return entry->handle == handle ? use(*entry->transfer) : trkInvalidHandle;
  }

  /// `end(transfer)`, after which the handle is invalid.
  template <typename End>
  trkError close(trkHandle handle, End&& end) {
    Entry* const entry = find(handle);
    if (entry == nullptr) return trkInvalidHandle;
    if (!entry->turn.wait()) return trkFailed;
    trkError ended = trkInvalidHandle;
    {
      const std::lock_guard<TurnLock> unlock(entry->turn, std::adopt_lock);
      if (entry->handle != handle) return trkInvalidHandle;
      ended = end(*entry->transfer);
      entry->clear();
    }
    give_back(index_of(handle));
    return ended;
  }

  /// Every open handle.
  std::vector<trkHandle> all() {
    std::vector<trkHandle> handles;
    for (auto& place : entries_) {
      Entry* const entry = place.load();
      if (entry == nullptr || !entry->turn.wait()) continue;
      const std::lock_guard<TurnLock> unlock(entry->turn, std::adopt_lock);
      if (entry->transfer) handles.push_back(entry->handle);
    }
    return handles;
  }

  /// At the end of the process: `end(transfer)` for all that are open, those included whose call was interrupted by the
  /// signal handler that ends it. What another thread still uses after a second is left.
  template <typename End>
  void close_all_at_exit(End&& end) noexcept {
    for (auto& place : entries_) {
      Entry* const entry = place.load();
      if (entry == nullptr) continue;
      const bool is_interrupted = entry->turn.is_mine();
      if (!is_interrupted && !entry->turn.wait_for(std::chrono::seconds(1))) continue;
      if (entry->transfer) guarded([&] { return end(*entry->transfer); });
      entry->clear();
      entry->turn.unlock();
    }
  }

 private:
  static constexpr std::size_t capacity = 4096;

  struct Entry {
    TurnLock turn;
    trkHandle handle = nullptr;  // null while it is free
    std::optional<Transfer> transfer;

    void clear() {
      handle = nullptr;
      transfer.reset();
    }
  };

  static std::size_t index_of(trkHandle handle) noexcept {
    return (reinterpret_cast<std::uintptr_t>(handle) >> 4U) % capacity;
  }
  Entry* find(trkHandle handle) noexcept {
    return handle == nullptr ? nullptr : entries_[index_of(handle)].load(std::memory_order_acquire);
  }

  std::size_t take_place() {
    const std::lock_guard lock(mutex_);
    if (!free_.empty()) {
      const std::size_t index = free_.back();
      free_.pop_back();
      return index;
    }
    if (used_ == capacity) throw std::bad_alloc();
    entries_[used_] = new Entry;
    return used_++;
  }
  void give_back(std::size_t index) {
    const std::lock_guard lock(mutex_);
    free_.push_back(index);
  }

  std::array<std::atomic<Entry*>, capacity> entries_{};  // never freed, used again
  std::mutex mutex_;                                     // of the next two
  std::vector<std::size_t> free_;
  std::size_t used_ = 0;
};

/// The handles of a kind, alive until the process ends: functions registered with atexit use them.
template <typename Transfer>
[[gnu::always_inline]] inline Handles<Transfer>& handles() {
  static auto* const all = new Handles<Transfer>;
  return *all;
}

}  // namespace trk_bridge::c_api
