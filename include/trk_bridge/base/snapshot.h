// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A value that one thread writes while others read consistent copies.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace trk_bridge::base {

/// One writer, any number of readers, no lock: the writer never waits, a reader copies again if the value was being
/// written.
template <typename T>
class Snapshot {
  static_assert(std::is_trivially_copyable_v<T>, "the value is copied word by word");

 public:
  Snapshot() { store(T{}); }

  /// Called by one thread at a time.
  void store(const T& value) noexcept {
    Words words{};
    std::memcpy(words.data(), &value, sizeof(T));
    const std::uint64_t version = version_.load(std::memory_order_relaxed);
    version_.store(version + 1, std::memory_order_relaxed);
    // Each store releases the odd version: a reader of a new word then sees a changed version.
    for (std::size_t i = 0; i < words.size(); ++i) words_[i].store(words[i], std::memory_order_release);
    version_.store(version + 2, std::memory_order_release);
  }

  T load() const noexcept {
    Words words;
    for (;;) {
      const std::uint64_t version = version_.load(std::memory_order_acquire);
      if (version % 2 != 0) continue;
      for (std::size_t i = 0; i < words.size(); ++i) words[i] = words_[i].load(std::memory_order_acquire);
      if (version_.load(std::memory_order_relaxed) == version) break;
    }
    T value;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return value;
  }

 private:
  static constexpr std::size_t count = (sizeof(T) + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
  using Words = std::array<std::uint64_t, count>;

  std::atomic<std::uint64_t> version_{0};
  std::array<std::atomic<std::uint64_t>, count> words_{};
};

}  // namespace trk_bridge::base
