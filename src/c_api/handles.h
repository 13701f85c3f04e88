// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Handles of open transfers: numbers, never addresses, so that any value from a program can be looked up safely.
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

#include "handle_lock.h"
#include "trk_struct.h"

namespace trk_bridge::c_api {

/// Converts exceptions to trkFailed: none may leave the C interface.
template <typename Call>
trkError guarded(Call&& call) noexcept {
  try {
    return call();
  } catch (...) {
    return trkFailed;
  }
}

/// A number that is unique in this process.
inline std::uint64_t next_serial() noexcept {
  // Not a small integer, because programs pass these by mistake.
  static std::atomic<std::uint64_t> last{0x74726B};
  return ++last;
}

/// The open transfers of one kind. Any thread; calls on one handle are serialised, calls on different handles are not.
/// A look-up takes only the lock of that handle.
template <typename Transfer>
class Handles {
 public:
  /// Throws std::bad_alloc, also if `capacity` handles are open.
  template <typename... Arguments>
  trkHandle open(Arguments&&... arguments) {
    const std::size_t index = take_place();
    Entry& entry = *entries_[index].load();
    entry.lock.wait();
    entry.transfer.emplace(std::forward<Arguments>(arguments)...);
    entry.handle = reinterpret_cast<trkHandle>(static_cast<std::uintptr_t>(next_serial() << 16U | index << 4U));
    const trkHandle handle = entry.handle;
    entry.lock.unlock();
    return handle;
  }

  /// Returns `use(transfer)`, or trkInvalidHandle. trkFailed in a signal handler that interrupted a call on this
  /// handle.
  template <typename Use>
  trkError with(trkHandle handle, Use&& use) {
    Entry* const entry = find(handle);
    if (entry == nullptr) return trkInvalidHandle;
    if (!entry->lock.wait()) return trkFailed;
    const std::lock_guard<HandleLock> unlock(entry->lock, std::adopt_lock);
    return entry->handle == handle ? use(*entry->transfer) : trkInvalidHandle;
  }

  /// Returns `end(transfer)` and makes the handle invalid.
  template <typename End>
  trkError close(trkHandle handle, End&& end) {
    Entry* const entry = find(handle);
    if (entry == nullptr) return trkInvalidHandle;
    if (!entry->lock.wait()) return trkFailed;
    trkError ended = trkInvalidHandle;
    {
      const std::lock_guard<HandleLock> unlock(entry->lock, std::adopt_lock);
      if (entry->handle != handle) return trkInvalidHandle;
      ended = end(*entry->transfer);
      entry->clear();
    }
    give_back(index_of(handle));
    return ended;
  }

  /// All open handles.
  std::vector<trkHandle> all() {
    std::vector<trkHandle> handles;
    for (auto& place : entries_) {
      Entry* const entry = place.load();
      if (entry == nullptr || !entry->lock.wait()) continue;
      const std::lock_guard<HandleLock> unlock(entry->lock, std::adopt_lock);
      if (entry->transfer) handles.push_back(entry->handle);
    }
    return handles;
  }

  /// At the end of the process: calls `end(transfer)` for all open handles, including one whose call was interrupted by
  /// the signal handler that ends the process. Skips a handle that another thread still uses after a second.
  template <typename End>
  void close_all_at_exit(End&& end) noexcept {
    for (auto& place : entries_) {
      Entry* const entry = place.load();
      if (entry == nullptr) continue;
      const bool is_interrupted = entry->lock.is_mine();
      if (!is_interrupted && !entry->lock.wait_for(std::chrono::seconds(1))) continue;
      if (entry->transfer) guarded([&] { return end(*entry->transfer); });
      entry->clear();
      entry->lock.unlock();
    }
  }

 private:
  static constexpr std::size_t capacity = 4096;

  struct Entry {
    HandleLock lock;
    trkHandle handle = nullptr;  // null if the entry is free
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

  std::array<std::atomic<Entry*>, capacity> entries_{};  // never freed, but reused
  std::mutex mutex_;                                     // protects the next two members
  std::vector<std::size_t> free_;
  std::size_t used_ = 0;
};

/// The handles of one kind. They are never destroyed: functions registered with atexit use them.
template <typename Transfer>
[[gnu::always_inline]] inline Handles<Transfer>& handles() {
  static auto* const all = new Handles<Transfer>;
  return *all;
}

}  // namespace trk_bridge::c_api
