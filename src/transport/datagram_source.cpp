// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "base/system_text.h"
#include "datagram.h"

#include <sys/epoll.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "counted_source.h"
#include "scheme.h"
#include "socket.h"

namespace trk_bridge::transport {
namespace {

// Available datagrams are read even after the deadline, but at most this number: datagrams without a result, such as
// those from refused senders, may arrive faster than they are read.
constexpr std::uint64_t most_after_deadline = 4096;

class DatagramSource final : public CountedSource {
 public:
  using Sockets = std::vector<std::unique_ptr<ReceiveSocket>>;

  DatagramSource(Sockets sockets, std::unique_ptr<Decoder> decoder)
      : CountedSource(name_of(sockets)), sockets_(std::move(sockets)), decoder_(std::move(decoder)) {
    if (sockets_.size() == 1) return;
    readable_ = Descriptor(::epoll_create1(EPOLL_CLOEXEC));
    for (const auto& socket : sockets_) {
      epoll_event readable{};
      readable.events = EPOLLIN;
      if (!readable_.is_open() || ::epoll_ctl(readable_.get(), EPOLL_CTL_ADD, socket->fd(), &readable) != 0) {
        throw TransportError("no descriptor for waiting: " + base::system_text(errno));
      }
    }
  }

  Event receive(Reception& into, std::chrono::nanoseconds wait) override;
  void stop() noexcept override {
    CountedSource::stop();
    for (const auto& socket : sockets_) socket->stop();
  }

 private:
  static std::string name_of(const Sockets& sockets) {
    std::string name;
    for (const auto& socket : sockets) name += (name.empty() ? "" : " and ") + socket->name();
    return name;
  }

  int fd() const noexcept { return readable_.is_open() ? readable_.get() : sockets_.front()->fd(); }
  bool has_more() const noexcept {
    return std::any_of(sockets_.begin(), sockets_.end(), [](const auto& socket) { return socket->has_more(); });
  }
  std::optional<ReceiveSocket::Datagram> next_datagram(bool waits, int& error) noexcept;
  Event too_long(const ReceiveSocket::Datagram& datagram, Reception& into) noexcept;
  void complete(SourceStatistics& statistics) const override;

  const Sockets sockets_;
  Descriptor readable_;           // an epoll set of all sockets, if there are several
  std::size_t first_socket_ = 0;  // the socket that is read first
  std::unique_ptr<Decoder> decoder_;
  bool has_datagram_ = false;  // the decoder has a datagram
  Sender sender_;
  std::int64_t arrival_ = 0;
};

/// With several sockets, it does not wait for one; they are read in turn.
std::optional<ReceiveSocket::Datagram> DatagramSource::next_datagram(bool waits, int& error) noexcept {
  for (std::size_t i = 0; i < sockets_.size(); ++i) {
    ReceiveSocket& socket = *sockets_[first_socket_];
    first_socket_ = (first_socket_ + 1) % sockets_.size();
    const auto datagram = socket.next(waits, error);
    if (datagram || is_permanent(error)) return datagram;
  }
  return std::nullopt;
}

Event DatagramSource::receive(Reception& into, std::chrono::nanoseconds wait) {
  const Deadline deadline(wait);
  for (std::uint64_t rounds = 0;; ++rounds) {
    if (const Event end = final_event(); end != Event::sample) return end;
    while (has_datagram_) {
      into.more = has_more();
      into.sample.sender = sender_;
      into.sample.arrival = arrival_;
      switch (decoder_->next(into.sample, into.fault)) {
        case Decoder::Next::sample:
          return sample(into.sample);
        case Decoder::Next::fault:
          return malformed();
        case Decoder::Next::none:
          has_datagram_ = false;
          break;
      }
    }
    if (rounds >= most_after_deadline && deadline.has_passed()) return Event::idle;
    int error = 0;
    const bool waits = deadline.is_endless() && sockets_.size() == 1;
    if (const auto datagram = next_datagram(waits, error)) {
      if (!datagram->is_allowed) {
        refused(datagram->sender);
        continue;
      }
      if (datagram->was_longer) return too_long(*datagram, into);
      sender_ = datagram->sender;
      arrival_ = datagram->arrival;
      has_datagram_ = true;
      decoder_->begin(datagram->bytes, sender_);
      continue;
    }
    if (is_permanent(error)) return failed(error);
    // Without a time limit, one system call waits and reads; with one, there are three calls.
    if (waits) continue;
    // Without waiting, only available datagrams are read.
    if (deadline.has_passed()) return Event::idle;
    switch (wait_readable(fd(), stop_event(), deadline)) {
      case Wake::readable:
        break;
      case Wake::stopped:
        return Event::stopped;
      case Wake::timeout:
        return Event::idle;
      case Wake::failed:
        return failed(errno);
    }
  }
}

/// The decoder does not get such a datagram.
Event DatagramSource::too_long(const ReceiveSocket::Datagram& datagram, Reception& into) noexcept {
  into.sample.sender = datagram.sender;
  into.sample.arrival = datagram.arrival;
  into.more = has_more();
  into.fault = wire::Fault{wire::Reason::too_long};
  return malformed();
}

void DatagramSource::complete(SourceStatistics& statistics) const {
  std::string why;
  for (const auto& socket : sockets_) {
    statistics.kernel_drops += socket->kernel_drops();
    statistics.receive_buffer += static_cast<std::uint64_t>(socket->granted_buffer());
    statistics.wanted_buffer += static_cast<std::uint64_t>(socket->wanted_buffer());
    if (why.empty()) why = socket->why_nothing_can_arrive();
  }
  if (statistics.state == SourceState::failed) return;
  if (why.empty() && statistics.state == SourceState::waiting) why = "bound, nothing received yet";
  if (!why.empty()) statistics.waiting_for = "udp port " + std::to_string(sockets_.front()->port()) + ": " + why;
}

}  // namespace

std::unique_ptr<Source> open_datagram_source(const ReceiveSettings& settings, std::unique_ptr<Decoder> decoder) {
  return open_datagram_source(std::vector<ReceiveSettings>{settings}, std::move(decoder));
}

std::unique_ptr<Source> open_datagram_source(const std::vector<ReceiveSettings>& places,
                                             std::unique_ptr<Decoder> decoder) {
  DatagramSource::Sockets sockets;
  for (const ReceiveSettings& settings : places) {
    try {
      sockets.push_back(std::make_unique<ReceiveSocket>(settings));
    } catch (const TransportError& error) {
      throw TransportError(udp_url(settings.host, settings.port) + ": " + error.what());
    }
  }
  return std::make_unique<DatagramSource>(std::move(sockets), std::move(decoder));
}

}  // namespace trk_bridge::transport
