#include "detect.h"

#include <ifaddrs.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string_view>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

#include <CLI/CLI.hpp>

#include "cli/checked_output.h"
#include "cli/stop_signals.h"
#include "detected.h"
#include "endpoints/schemes.h"
#include "monitor/model.h"
#include "transport/datagram.h"

namespace trk_bridge::tools {
namespace {

using Clock = std::chrono::steady_clock;
using transport::Detection;
using transport::Scheme;
using transport::Sender;

// The kernel keeps what comes meanwhile.
constexpr std::chrono::milliseconds pause{20};
// Senders of what is no sound record, of one place; a port scan could produce any number.
constexpr std::size_t most_faulty = 16;
constexpr std::size_t shown_bytes = 16;

struct Place {
  std::uint16_t port = 0;
  std::string host;           // a group or an address of this machine; empty: every address
  bool is_every_one = false;  // one of all addresses of this machine
};
bool operator<(const Place& a, const Place& b) { return std::tie(a.port, a.host) < std::tie(b.port, b.host); }

/// A way to read a protocol, and what it gave.
struct Reading {
  const Scheme* scheme;
  Detection::Reading way;
  monitor::Model model{Clock::now()};
  std::map<cli::Tally::Key, Motion, cli::Tally::Less> motions{};
};

transport::Fault unknown_protocol() noexcept {
  return {"unknown protocol", [](const transport::Fault&) { return std::string("no protocol that is known here"); }, 0,
          -1};
}

/// Tries all ways to read a datagram, and takes the first that finds no fault.
class AnyDecoder final : public transport::Decoder {
 public:
  AnyDecoder() {
    for (const Scheme* scheme : endpoints::schemes()) {
      if (scheme->detection == nullptr) continue;
      for (auto& way : scheme->detection->readings()) readings_.emplace_back(Reading{scheme, std::move(way)});
    }
  }

  void begin(std::string_view datagram, const Sender& sender) noexcept override {
    datagram_ = datagram;
    chosen_ = nullptr;
    claimed_by_ = nullptr;
    first_ = Next::fault;
    fault_ = unknown_protocol();
    for (Reading& reading : readings_) {
      if (!reading.scheme->detection->claims(datagram)) continue;
      // All of them see every datagram: they may put segments together.
      reading.way.decoder->begin(datagram, sender);
      transport::Sample sample;
      transport::Fault fault;
      const Next next = reading.way.decoder->next(sample, fault);
      if (chosen_ == nullptr && next != Next::fault) {
        chosen_ = &reading;
        first_ = next;
        sample_ = sample;
      } else if (claimed_by_ == nullptr) {
        // What the strictest way says of it.
        fault_ = fault;
      }
      claimed_by_ = reading.scheme;
      if (chosen_ == &reading) continue;
      for (Next rest = next; rest != Next::none;) rest = reading.way.decoder->next(sample, fault);
    }
    is_first_ = true;
  }

  Next next(transport::Sample& into, transport::Fault& fault) noexcept override {
    if (std::exchange(is_first_, false)) {
      // Sender and arrival are not the decoder's to say.
      sample_.sender = into.sender;
      sample_.arrival = into.arrival;
      into = sample_;
      fault = fault_;
      return first_;
    }
    if (chosen_ == nullptr) return Next::none;
    return chosen_->way.decoder->next(into, fault);
  }

  /// Of the datagram of the last begin(): the way it is read; null: none.
  Reading* chosen() const noexcept { return chosen_; }
  /// The protocol that it claims to be of; null: none.
  const Scheme* claimed_by() const noexcept { return claimed_by_; }
  std::string_view datagram() const noexcept { return datagram_; }
  std::vector<Reading>& readings() noexcept { return readings_; }

 private:
  std::vector<Reading> readings_;
  std::string_view datagram_;
  Reading* chosen_ = nullptr;
  const Scheme* claimed_by_ = nullptr;
  transport::Sample sample_;
  transport::Fault fault_;
  Next first_ = Next::none;
  bool is_first_ = false;
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
  explicit Listening(Place place) : place_(std::move(place)) {
    transport::ReceiveSettings settings;
    settings.host = place_.host;
    settings.port = place_.port;
    auto decoder = std::make_unique<AnyDecoder>();
    decoder_ = decoder.get();
    source_ = transport::open_datagram_source(settings, std::move(decoder));
  }

  const transport::Source& source() const { return *source_; }

  /// Takes what has come so far.
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

  /// Every camera that was found.
  std::vector<Detected> cameras() {
    std::vector<Detected> found;
    for (Reading& reading : decoder_->readings()) {
      const auto state = reading.model.state(Clock::now(), *source_);
      for (const auto& camera : state.cameras) {
        if (camera.latest) add(reading, camera, state, found);
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

  /// What came that is no sound record, a line a sender.
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
    std::string text;  // of the last one
  };

  void add(const transport::Sample& sample) {
    Reading& reading = *decoder_->chosen();
    reading.model.add(sample, Clock::now());
    const auto* params = std::get_if<wire::CameraParams>(&sample.record);
    if (params == nullptr) return;
    if (const auto pose = camera::decode_pose(*params)) reading.motions[{params->id, sample.sender}].add(*pose);
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

  void add(const Reading& reading, const monitor::CameraState& camera, const monitor::State& state,
           std::vector<Detected>& found) const {
    Detected one;
    one.protocol = reading.scheme->detection->protocol;
    one.place = source_->name();
    one.source = url(reading);
    one.camera = camera;
    if (!camera.constants) {
      // Constants without an id are for all cameras of their sender.
      for (const auto& other : state.cameras) {
        if (other.key.id == 0 && other.key.sender == camera.key.sender) one.camera.constants = other.constants;
      }
    }
    if (const auto motion = reading.motions.find(camera.key); motion != reading.motions.end()) {
      one.motion = motion->second;
    }
    const auto same = std::find_if(found.begin(), found.end(), [&](const Detected& other) {
      return other.protocol == one.protocol && other.camera.key.id == camera.key.id &&
             other.camera.key.sender == camera.key.sender;
    });
    if (same == found.end()) {
      found.push_back(std::move(one));
      return;
    }
    // Two ways read some of its records each: the one that reads more is the right one.
    if (same->camera.counts.accepted < camera.counts.accepted) *same = std::move(one);
    same->other_options = reading.way.options;
  }

  std::string url(const Reading& reading) const {
    const std::string place = transport::udp_url(place_.is_every_one ? "" : place_.host, place_.port);
    return std::string(reading.scheme->name) + place.substr(place.find(':')) +
           (reading.way.options.empty() ? "" : "?" + reading.way.options);
  }

  const Place place_;
  AnyDecoder* decoder_ = nullptr;  // the source has it
  std::unique_ptr<transport::Source> source_;
  std::map<std::string, Faulty> faulty_;  // by sender
};

Place place_from(const std::string& text) {
  transport::Url url;
  url.scheme = "udp";
  url.place = text.find(':') == std::string::npos ? "//:" + text : "//" + text;
  transport::ReceiveSettings settings;
  const auto place = transport::set_place(url, settings);
  if (!place || settings.port == 0) {
    throw CLI::ValidationError("PORT = \"" + text +
                               "\": allowed are 1 to 65535, and a group before it as in 239.135.1.1:55555");
  }
  return {settings.port, settings.host};
}

std::vector<transport::UsualPlace> usual_places() {
  std::vector<transport::UsualPlace> all;
  for (const Scheme* scheme : endpoints::schemes()) {
    if (scheme->detection == nullptr) continue;
    for (auto& place : scheme->detection->places()) all.push_back(std::move(place));
  }
  return all;
}

std::vector<std::string> own_addresses() {
  std::vector<std::string> all;
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) {
    throw transport::TransportError("the addresses of this machine: " + std::generic_category().message(errno));
  }
  for (const ifaddrs* one = list; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr) continue;
    const int family = one->ifa_addr->sa_family;
    if (family != AF_INET && family != AF_INET6) continue;
    const auto size = static_cast<socklen_t>(family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6));
    char text[NI_MAXHOST];
    if (::getnameinfo(one->ifa_addr, size, text, sizeof text, nullptr, 0, NI_NUMERICHOST) == 0) all.emplace_back(text);
  }
  ::freeifaddrs(list);
  return all;
}

/// A port together with the groups that usually come to it. The kernel does not let a group be received beside a socket
/// of every address: where there are groups, each address of this machine has a socket.
void add_with_groups(std::uint16_t port, const std::vector<transport::UsualPlace>& usual, std::set<Place>& places) {
  bool has_groups = false;
  for (const auto& place : usual) {
    if (place.port != port || place.group.empty()) continue;
    has_groups = true;
    places.insert({port, place.group});
  }
  if (!has_groups) {
    places.insert({port, ""});
    return;
  }
  for (auto& address : own_addresses()) places.insert({port, std::move(address), true});
}

std::set<Place> places_of(const std::vector<std::string>& chosen) {
  const auto usual = usual_places();
  std::set<Place> places;
  for (const auto& text : chosen) {
    Place place = place_from(text);
    if (place.host.empty()) {
      add_with_groups(place.port, usual, places);
    } else {
      places.insert(std::move(place));
    }
  }
  if (!chosen.empty()) return places;
  for (const auto& place : usual) add_with_groups(place.port, usual, places);
  return places;
}

/// Every socket needs some descriptors, and a protocol may have hundreds of groups.
void allow_many_descriptors() noexcept {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  // Where it is refused, the sockets beyond the limit say so.
  (void)::setrlimit(RLIMIT_NOFILE, &limit);
}

void say_what_to_check(bool chosen_places, std::ostream& err) {
  err << "trk: nothing was found. To check:\n"
         "trk:  - the tracker: is its output switched on, and does it send to an address of this machine (ip -br "
         "address)?\n"
         "trk:  - the port: which one is it set to? "
      << (chosen_places ? "Only the places above were listened to" : "trk detect PORT listens to any other")
      << "\n"
         "trk:  - the network: sudo tcpdump -ni any udp shows what arrives; what it shows and trk does not see, a "
         "firewall drops\n"
         "trk:  - multicast: switches pass a group on where something asks for it (IGMP); the sender's TTL must reach "
         "here\n"
         "trk:  - other programs: a port that is in use is read by the program that has it (ss -lunp)\n";
}

}  // namespace

cli::ExitCode detect(const DetectOptions& options, std::ostream& out, std::ostream& err) {
  const std::set<Place> places = places_of(options.places);
  allow_many_descriptors();

  std::vector<std::unique_ptr<Listening>> all;
  std::set<std::uint16_t> ports;
  for (const Place& place : places) {
    try {
      all.push_back(std::make_unique<Listening>(place));
      ports.insert(place.port);
    } catch (const transport::TransportError& error) {
      err << "trk: not heard: " << error.what() << '\n';
    }
  }
  if (all.empty()) {
    err << "trk: error: none of the places can be listened to\n";
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
  if (is_empty) say_what_to_check(!options.places.empty(), err);
  const cli::ExitCode written = lines.finish(err);
  return is_empty ? cli::exit_failed : written;
}

void list_usual_places(std::ostream& out) {
  for (const Scheme* scheme : endpoints::schemes()) {
    if (scheme->detection == nullptr) continue;
    // Groups that are numbered are a line: the first and the last.
    std::map<std::string_view, std::vector<transport::UsualPlace>> by_senders;
    std::vector<std::string_view> order;
    for (auto& place : scheme->detection->places()) {
      auto& same = by_senders[place.senders];
      if (same.empty()) order.push_back(place.senders);
      same.push_back(std::move(place));
    }
    for (const auto senders : order) {
      const auto& same = by_senders[senders];
      out << same.front().port << "  " << scheme->detection->protocol << "  " << senders;
      if (!same.front().group.empty()) out << "  " << same.front().group << " to " << same.back().group;
      out << '\n';
    }
  }
}

}  // namespace trk_bridge::tools
