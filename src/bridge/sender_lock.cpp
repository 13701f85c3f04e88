// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "sender_lock.h"

#include <algorithm>

namespace trk_bridge::bridge {
namespace {

bool same_address(const transport::Sender& a, const transport::Sender& b) noexcept {
  return a.kind == b.kind && a.address == b.address;
}

}  // namespace

bool SenderLock::is_holder(const transport::Sender& sender) const noexcept {
  return holder_ && same_address(*holder_, sender) && (ignores_ports_ || holder_->number == sender.number);
}

SenderLock::Claim SenderLock::claim(const transport::Sender& sender, std::int64_t now) const noexcept {
  if (is_holder(sender)) return Claim::holds;
  return holder_ && now - last_heard_ < failover_ ? Claim::foreign : Claim::free;
}

void SenderLock::take(const transport::Sender& sender, std::int64_t now) noexcept {
  ignores_ports_ = ignores_ports_ && is_holder(sender);
  holder_ = sender;
  last_heard_ = now;
  port_count_ = 0;
}

void SenderLock::note_foreign(const transport::Sender& sender) noexcept {
  if (!same_address(*holder_, sender)) return;
  const auto end = ports_.begin() + port_count_;
  if (std::find(ports_.begin(), end, sender.number) != end) {
    // The port is used again: it belongs to another sender.
    port_count_ = 0;
    return;
  }
  ports_[port_count_++] = sender.number;
  ignores_ports_ = port_count_ == most_ports;
  if (ignores_ports_) port_count_ = 0;
}

}  // namespace trk_bridge::bridge
