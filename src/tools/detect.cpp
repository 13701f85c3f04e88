// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "detect.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string_view>
#include <thread>
#include <utility>

#include "any_decoder.h"
#include "cli/checked_output.h"
#include "cli/stop_signals.h"
#include "detect_places.h"
#include "detected.h"
#include "monitor/model.h"
#include "transport/datagram.h"

namespace trk_bridge::tools {
namespace {

using Clock = std::chrono::steady_clock;

// The kernel queues what arrives meanwhile.
constexpr std::chrono::milliseconds pause{20};
// Senders of malformed datagrams per place; limited, because a port scan could produce any number.
constexpr std::size_t most_faulty = 16;
constexpr std::size_t shown_bytes = 16;

/// Records of one reading.
struct Received {
  monitor::Model model{Clock::now()};
  std::map<cli::Tally::Key, Motion, cli::Tally::Less> motions{};
};

std::string hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char c : bytes.substr(0, shown_bytes)) {
    char pair[4];
    std::snprintf(pair, sizeof pair, " %02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    text += pair;
  }
  return text + (bytes.size() > shown_bytes ? " …" : "");
}

/// One port or group.
class Listening {
 public:
  /// Throws TransportError.
  explicit Listening(DetectPlace place) : place_(std::move(place)) {
    transport::ReceiveSettings settings;
    settings.host = place_.host;
    settings.port = place_.port;
    auto decoder = std::make_unique<AnyDecoder>();
    decoder_ = decoder.get();
    source_ = transport::open_datagram_source(settings, std::move(decoder));
  }

  const transport::Source& source() const { return *source_; }

  /// Processes everything that has arrived so far.
  void take() {
    transport::Reception reception;
    for (;;) {
      switch (source_->receive(reception, std::chrono::nanoseconds::zero())) {
        case transport::Event::sample:
          add(reception.sample);
          break;
        case transport::Event::malformed:
          add_faulty(reception);
          break;
        default:
          return;
      }
    }
  }

  /// All cameras that were found.
  std::vector<Detected> cameras() {
    std::vector<Detected> found;
    for (const auto& reading : decoder_->readings()) {
      const auto received = received_.find(&reading);
      if (received == received_.end()) continue;
      const auto state = received->second.model.state(Clock::now(), *source_);
      for (const auto& camera : state.cameras) {
        if (camera.latest) add(detected(reading, camera, state), reading, found);
      }
    }
    for (Detected& one : found) {
      const auto& key = one.camera.key;
      for (const Detected& other : found) {
        one.needs_id = one.needs_id || other.camera.key.id != key.id;
        one.is_shared = one.is_shared || (other.camera.key.id == key.id && other.camera.key.sender != key.sender);
      }
    }
    return found;
  }

  /// Malformed datagrams, one line per sender.
  std::vector<std::string> faulty() const {
    std::vector<std::string> lines;
    for (const auto& [sender, what] : faulty_) {
      lines.push_back(source_->name() + ": " + std::to_string(what.count) + " datagrams from " + sender + ", " +
                      what.text);
    }
    return lines;
  }

 private:
  struct Faulty {
    std::uint64_t count = 0;
    std::string text;  // of the last datagram
  };

  void add(const transport::Sample& sample) {
    Received& received = received_[decoder_->chosen()];
    received.model.add(sample, Clock::now());
    const auto* params = std::get_if<wire::CameraParams>(&sample.record);
    if (params == nullptr) return;
    if (const auto pose = camera::decode_pose(*params)) received.motions[{params->id, sample.sender}].add(*pose);
  }

  void add_faulty(const transport::Reception& reception) {
    const std::string sender = transport::to_string(reception.sample.sender);
    if (faulty_.size() == most_faulty && faulty_.count(sender) == 0) return;
    Faulty& faulty = faulty_[sender];
    ++faulty.count;
    const auto* scheme = decoder_->claimed_by();
    faulty.text = scheme == nullptr
                      ? describe(reception.fault)
                      : std::string(scheme->detection->protocol) + " with a fault: " + describe(reception.fault);
    const std::string_view bytes = decoder_->datagram();
    faulty.text += " (the last one has " + std::to_string(bytes.size()) + " bytes:" + hexadecimal(bytes) + ")";
  }

  Detected detected(const AnyDecoder::Reading& reading, const monitor::CameraState& camera,
                    const monitor::State& state) const {
    Detected one;
    one.protocol = reading.scheme->detection->protocol;
    one.place = source_->name();
    one.source = url(reading);
    one.camera = camera;
    if (!camera.constants) {
      // Constants without an id are valid for all cameras of their sender.
      for (const auto& other : state.cameras) {
        if (other.key.id == 0 && other.key.sender == camera.key.sender) one.camera.constants = other.constants;
      }
    }
    const auto& motions = received_.at(&reading).motions;
    if (const auto motion = motions.find(camera.key); motion != motions.end()) one.motion = motion->second;
    return one;
  }

  /// A looser reading gets only records that the stricter one refuses. The reading with more records is used; if it is
  /// the stricter one, the options of the other are mentioned.
  static void add(Detected one, const AnyDecoder::Reading& reading, std::vector<Detected>& found) {
    const auto& key = one.camera.key;
    const auto stricter = std::find_if(found.begin(), found.end(), [&](const Detected& other) {
      return other.protocol == one.protocol && other.camera.key.id == key.id && other.camera.key.sender == key.sender;
    });
    if (stricter == found.end()) {
      found.push_back(std::move(one));
    } else if (stricter->camera.counts.accepted < one.camera.counts.accepted) {
      *stricter = std::move(one);
    } else {
      stricter->other_options = reading.way.options;
    }
  }

  std::string url(const AnyDecoder::Reading& reading) const {
    const std::string place = transport::udp_url(place_.is_own_address ? "" : place_.host, place_.port);
    return std::string(reading.scheme->name) + place.substr(place.find(':')) +
           (reading.way.options.empty() ? "" : "?" + reading.way.options);
  }

  const DetectPlace place_;
  AnyDecoder* decoder_ = nullptr;  // owned by the source
  std::unique_ptr<transport::Source> source_;
  std::map<const AnyDecoder::Reading*, Received> received_;
  std::map<std::string, Faulty> faulty_;  // by sender
};

/// Every socket needs several descriptors, and a protocol may have hundreds of groups.
void allow_many_descriptors() noexcept {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  // If this fails, the sockets beyond the limit report an error.
  (void)::setrlimit(RLIMIT_NOFILE, &limit);
}

void print_checks(bool chosen_places, std::ostream& err) {
  err << "trk: nothing was found. To check:\n"
         "trk:  - the tracker: is its output on, and does it send to an address of this machine (ip -br address)?\n"
         "trk:  - the port: which port does the tracker use? "
      << (chosen_places ? "Only the ports above were tested" : "trk detect PORT tests any other port")
      << "\n"
         "trk:  - the network: sudo tcpdump -ni any udp shows what arrives; if trk does not receive it, a firewall "
         "drops it\n"
         "trk:  - multicast: switches forward a group only to receivers that join it (IGMP); the TTL of the sender "
         "must be large enough\n"
         "trk:  - other programs: if another program uses the port, it receives the datagrams (ss -lunp)\n";
}

}  // namespace

cli::ExitCode detect(const DetectOptions& options, std::ostream& out, std::ostream& err) {
  const std::set<DetectPlace> places = places_of(options.places);
  allow_many_descriptors();

  std::vector<std::unique_ptr<Listening>> all;
  std::set<std::uint16_t> ports;
  for (const DetectPlace& place : places) {
    try {
      all.push_back(std::make_unique<Listening>(place));
      ports.insert(place.port);
    } catch (const transport::TransportError& error) {
      err << "trk: cannot listen: " << error.what() << '\n';
    }
  }
  if (all.empty()) {
    err << "trk: error: cannot listen to any of the ports\n";
    return cli::exit_failed;
  }
  err << "trk: listening for " << options.seconds << " s to port";
  for (const std::uint16_t port : ports) err << ' ' << port;
  err << " (" << all.size() << " addresses and groups)";
  err << '\n' << std::flush;

  const cli::StopSignals signals;
  const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
  while (!cli::StopSignals::stopped() && Clock::now() < end) {
    for (const auto& listening : all) listening->take();
    std::this_thread::sleep_for(pause);
  }

  cli::CheckedOutput lines(out);
  bool is_empty = true;
  for (const auto& listening : all) {
    listening->take();
    for (const Detected& found : listening->cameras()) {
      is_empty = false;
      if (options.json) {
        lines.line(json_of(found), false);
        continue;
      }
      for (const auto& line : lines_of(found)) lines.line(line, false);
    }
    for (const auto& line : listening->faulty()) err << "trk: " << line << '\n';
    if (const auto statistics = listening->source().statistics(); !statistics.error.empty()) {
      err << "trk: " << statistics.error << '\n';
    }
  }
  if (is_empty) print_checks(!options.places.empty(), err);
  const cli::ExitCode written = lines.finish(err);
  return is_empty ? cli::exit_failed : written;
}

}  // namespace trk_bridge::tools
