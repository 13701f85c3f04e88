// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Messages that are published by pointer and reused when no subscriber holds them any more.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

namespace trk_bridge::ros1 {

/// An empty message with a frame.
template <typename Message>
Message in_frame(const std::string& frame) {
  Message message;
  message.header.frame_id = frame;
  return message;
}

/// Subscribers in the same process receive the published pointer: nothing is serialised or copied for them, and they
/// may keep the message. Not synchronised; threads of subscribers may release messages at any time. Allocates only
/// while subscribers keep more than `size` messages.
template <typename Message>
class MessagePool {
 public:
  static constexpr std::size_t size = 8;

  /// Every new message is a copy of `prototype`.
  explicit MessagePool(const Message& prototype) : prototype_(prototype) {
    for (auto& message : messages_) message = boost::make_shared<Message>(prototype_);
  }
  MessagePool(const MessagePool&) = delete;
  MessagePool& operator=(const MessagePool&) = delete;

  /// Makes an unused message the current one. It contains old data: all members must be written.
  Message& renew() {
    now_ = (now_ + 1) % size;
    auto& message = messages_[now_];
    if (message.use_count() != 1) message = boost::make_shared<Message>(prototype_);
    // The last reads of subscribers happened before this.
    std::atomic_thread_fence(std::memory_order_acquire);
    return *message;
  }

  /// The message of the last renew(); the prototype before that.
  const boost::shared_ptr<Message>& current() const noexcept { return messages_[now_]; }

 private:
  const Message prototype_;
  std::array<boost::shared_ptr<Message>, size> messages_;
  std::size_t now_ = 0;
};

}  // namespace trk_bridge::ros1
