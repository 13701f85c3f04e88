// Messages that are published by pointer, and used again once nobody has them any more.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

namespace trk_bridge::ros1 {

/// Empty but for its frame.
template <typename Message>
Message in_frame(const std::string& frame) {
  Message message;
  message.header.frame_id = frame;
  return message;
}

/// What is published by pointer reaches subscribers of the same process as it is: nothing is serialised or copied for
/// them, and the message is theirs for as long as they like. Not synchronised; subscribers' threads may let go of
/// messages at any time. Allocates only while subscribers keep more messages than `size`.
template <typename Message>
class MessagePool {
 public:
  static constexpr std::size_t size = 8;

  /// Every new message begins as a copy of `prototype`.
  explicit MessagePool(const Message& prototype) : prototype_(prototype) {
    for (auto& message : messages_) message = boost::make_shared<Message>(prototype_);
  }
  MessagePool(const MessagePool&) = delete;
  MessagePool& operator=(const MessagePool&) = delete;

  /// Makes a message that nobody else has the current one. It holds what an earlier one held: all of it must be
  /// written.
  Message& renew() {
    now_ = (now_ + 1) % size;
    auto& message = messages_[now_];
    if (message.use_count() != 1) message = boost::make_shared<Message>(prototype_);
    // What the last subscriber read of it was before.
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
