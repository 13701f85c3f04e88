#include "datagram.h"

#include <cerrno>
#include <string>
#include <utility>

#include "counted_source.h"
#include "scheme.h"

namespace trk_bridge::transport {
namespace {

// Errors that stay. Others are of one datagram or one moment, such as an interface that went down.
bool ends_source(int error) noexcept {
  return error == EBADF || error == ENOTSOCK || error == EFAULT || error == EINVAL;
}

class DatagramSource final : public CountedSource {
 public:
  DatagramSource(std::unique_ptr<ReceiveSocket> socket, std::unique_ptr<Decoder> decoder)
      : CountedSource(socket->name()), socket_(std::move(socket)), decoder_(std::move(decoder)) {}

  Event receive(Reception& into, std::chrono::nanoseconds wait) override;

 private:
  bool next_datagram(Reception& into, int& error) noexcept;
  void complete(SourceStatistics& statistics) const override;

  std::unique_ptr<ReceiveSocket> socket_;
  std::unique_ptr<Decoder> decoder_;
  bool has_datagram_ = false;  // the decoder has
  bool was_longer_ = false;    // than any datagram may be: it is not the decoder's
  Sender sender_;
  std::int64_t arrival_ = 0;
};

Event DatagramSource::receive(Reception& into, std::chrono::nanoseconds wait) {
  const Deadline deadline(wait);
  for (;;) {
    if (const Event end = final_event(); end != Event::sample) return end;
    while (has_datagram_) {
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
    int error = 0;
    if (next_datagram(into, error)) {
      if (was_longer_) return malformed();
      continue;
    }
    if (ends_source(error)) return failed(error);
    switch (wait_readable(socket_->fd(), stop_event(), deadline)) {
      case Wake::readable:
        // With no time to wait, what is there was asked for already.
        if (!deadline.is_endless() && deadline.left() == std::chrono::nanoseconds::zero()) return Event::idle;
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

/// The next datagram of a sender that is allowed.
bool DatagramSource::next_datagram(Reception& into, int& error) noexcept {
  for (;;) {
    const auto datagram = socket_->next(error);
    if (!datagram) return false;
    if (!datagram->is_allowed) {
      refused(datagram->sender);
      continue;
    }
    sender_ = datagram->sender;
    arrival_ = datagram->arrival;
    was_longer_ = datagram->was_longer;
    has_datagram_ = !was_longer_;
    if (was_longer_) {
      into.sample.sender = sender_;
      into.sample.arrival = arrival_;
      into.fault = wire::Fault{wire::Reason::too_long};
    } else {
      decoder_->begin(datagram->bytes, sender_);
    }
    return true;
  }
}

void DatagramSource::complete(SourceStatistics& statistics) const {
  statistics.kernel_drops = socket_->kernel_drops();
  if (statistics.state == SourceState::waiting) {
    statistics.waiting_for = "udp port " + std::to_string(socket_->port()) + ": bound, nothing received yet";
  }
}

}  // namespace

std::unique_ptr<Source> open_datagram_source(const ReceiveSettings& settings, std::unique_ptr<Decoder> decoder) {
  try {
    return std::make_unique<DatagramSource>(std::make_unique<ReceiveSocket>(settings), std::move(decoder));
  } catch (const TransportError& error) {
    throw TransportError(udp_url(settings.host, settings.port) + ": " + error.what());
  }
}

}  // namespace trk_bridge::transport
