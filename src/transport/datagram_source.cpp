#include "datagram.h"

#include <cerrno>
#include <cstdint>
#include <string>
#include <utility>

#include "counted_source.h"
#include "scheme.h"

namespace trk_bridge::transport {
namespace {

// What is there already is read even when the time is up, but no more than this of it: datagrams that give nothing, as
// those of refused senders, may come faster than they are read.
constexpr std::uint64_t most_after_deadline = 4096;

class DatagramSource final : public CountedSource {
 public:
  DatagramSource(std::unique_ptr<ReceiveSocket> socket, std::unique_ptr<Decoder> decoder)
      : CountedSource(socket->name()), socket_(std::move(socket)), decoder_(std::move(decoder)) {}

  Event receive(Reception& into, std::chrono::nanoseconds wait) override;
  void stop() noexcept override {
    CountedSource::stop();
    socket_->stop();
  }

 private:
  Event too_long(const ReceiveSocket::Datagram& datagram, Reception& into) noexcept;
  void complete(SourceStatistics& statistics) const override;

  std::unique_ptr<ReceiveSocket> socket_;
  std::unique_ptr<Decoder> decoder_;
  bool has_datagram_ = false;  // the decoder has
  Sender sender_;
  std::int64_t arrival_ = 0;
};

Event DatagramSource::receive(Reception& into, std::chrono::nanoseconds wait) {
  const Deadline deadline(wait);
  for (std::uint64_t rounds = 0;; ++rounds) {
    if (const Event end = final_event(); end != Event::sample) return end;
    while (has_datagram_) {
      into.more = socket_->has_more();
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
    if (const auto datagram = socket_->next(deadline.is_endless(), error)) {
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
    if (is_lasting(error)) return failed(error);
    // One system call waits and reads; with a time limit there are three.
    if (deadline.is_endless()) continue;
    // With no time to wait, what is there was asked for.
    if (deadline.has_passed()) return Event::idle;
    switch (wait_readable(socket_->fd(), stop_event(), deadline)) {
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

/// It is not the decoder's.
Event DatagramSource::too_long(const ReceiveSocket::Datagram& datagram, Reception& into) noexcept {
  into.sample.sender = datagram.sender;
  into.sample.arrival = datagram.arrival;
  into.more = socket_->has_more();
  into.fault = wire::Fault{wire::Reason::too_long};
  return malformed();
}

void DatagramSource::complete(SourceStatistics& statistics) const {
  statistics.kernel_drops = socket_->kernel_drops();
  statistics.receive_buffer = static_cast<std::uint64_t>(socket_->granted_buffer());
  statistics.wanted_buffer = static_cast<std::uint64_t>(socket_->wanted_buffer());
  if (statistics.state == SourceState::failed) return;
  std::string why = socket_->why_nothing_can_come();
  if (why.empty() && statistics.state == SourceState::waiting) why = "bound, nothing received yet";
  if (!why.empty()) statistics.waiting_for = "udp port " + std::to_string(socket_->port()) + ": " + why;
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
