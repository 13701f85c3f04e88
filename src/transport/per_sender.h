// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Data that a decoder stores for each sender.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "trk_bridge/transport/sample.h"

namespace trk_bridge::transport {

/// Data of up to `capacity` senders; a new sender replaces the one that was silent longest. Allocates nothing itself.
template <typename Value, std::size_t capacity>
class PerSender {
 public:
  /// The data of the sender; null: none. Valid until add().
  Value* find(const Sender& sender) noexcept {
    if (recent_ < count_ && entries_[recent_].sender == sender) return used(recent_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (entries_[i].sender == sender) return used(i);
    }
    return nullptr;
  }

  /// Adds a sender that find() does not find.
  Value& add(const Sender& sender, Value value) {
    std::size_t place = count_;
    if (count_ < capacity) {
      ++count_;
    } else {
      const auto oldest = std::min_element(entries_.begin(), entries_.end(),
                                           [](const Entry& a, const Entry& b) { return a.last_used < b.last_used; });
      place = static_cast<std::size_t>(oldest - entries_.begin());
    }
    entries_[place].sender = sender;
    entries_[place].value = std::move(value);
    return *used(place);
  }

 private:
  struct Entry {
    Sender sender;
    Value value{};
    std::uint64_t last_used = 0;
  };

  Value* used(std::size_t place) noexcept {
    recent_ = place;
    entries_[place].last_used = ++uses_;
    return &entries_[place].value;
  }

  std::array<Entry, capacity> entries_{};
  std::size_t count_ = 0;
  std::size_t recent_ = 0;  // most datagrams come from the same sender as the previous one
  std::uint64_t uses_ = 0;
};

}  // namespace trk_bridge::transport
