#include "trk_bridge/transport/endpoint.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <utility>

#include "trk_bridge/transport/take_file.h"
#include "url.h"

namespace trk_bridge::transport {

namespace {

using Result = tl::expected<Endpoint, std::string>;

enum class For : std::uint8_t { read, write, both };

constexpr bool is_for(For use, Direction direction) noexcept {
  return use == For::both || (use == For::read) == (direction == Direction::read);
}

/// One option of a scheme. `set` says whether the value is one of the `allowed`.
template <typename E>
struct Option {
  std::string_view key;
  For use;
  std::string_view allowed;
  bool (*set)(const std::string& value, E& endpoint);
};

constexpr std::string_view switch_allowed = "0 and 1";
constexpr std::string_view layout_allowed =
    "auto, document and identified, the latter two also followed by _lp64, _llp64 or _i386 and that by _le or _be";

template <typename T>
std::optional<T> whole_number(std::string_view text, T lowest, T highest, int base = 10) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc{} || end != text.data() + text.size() || number < lowest || number > highest) return {};
  return number;
}

std::optional<double> real_number(std::string_view text, double lowest, double highest) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !(number >= lowest && number <= highest)) return {};
  return number;
}

template <typename T, typename U>
bool assign(const std::optional<T>& value, U& to) {
  if (value) to = *value;
  return value.has_value();
}

bool assign_switch(const std::string& value, bool& to) {
  if (value != "0" && value != "1") return false;
  to = value == "1";
  return true;
}

bool assign_layout(const std::string& value, wire::LayoutChoice& to) {
  const auto choice = wire::layout_choice_from_word(value);
  if (choice) to = *choice;
  return choice.has_value();
}

bool assign_hosts(const std::string& value, std::vector<std::string>& to) {
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find(',', begin), value.size());
    if (end == begin) return false;
    std::string host = value.substr(begin, end - begin);
    // As in a URL's host, an IPv6 address may stand in brackets.
    if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    if (host.empty()) return false;
    to.push_back(std::move(host));
    begin = end + 1;
  }
  return true;
}

bool assign_date(const std::string& value, std::optional<std::int64_t>& to) {
  if (value.size() != 10 || value[4] != '-' || value[7] != '-') return false;
  const std::string_view text = value;
  const auto year = whole_number(text.substr(0, 4), 1970, 9999);
  const auto month = whole_number(text.substr(5, 2), 1, 12);
  const auto day = whole_number(text.substr(8, 2), 1, 31);
  if (!year || !month || !day) return false;
  std::tm date{};
  date.tm_year = *year - 1900;
  date.tm_mon = *month - 1;
  date.tm_mday = *day;
  const std::time_t seconds = ::timegm(&date);
  // timegm turns 30 February into 1 or 2 March.
  if (date.tm_mon != *month - 1) return false;
  to = seconds;
  return true;
}

constexpr std::array<Option<UdpEndpoint>, 7> udp_options{{
    {"allow", For::read, "addresses with a comma between",
     [](const std::string& v, UdpEndpoint& e) { return assign_hosts(v, e.allow); }},
    {"interface", For::both, "an address of this machine or an interface's name",
     [](const std::string& v, UdpEndpoint& e) { return !(e.interface = v).empty(); }},
    {"layout", For::both, layout_allowed,
     [](const std::string& v, UdpEndpoint& e) { return assign_layout(v, e.layout); }},
    {"buffer", For::read, "bytes from 1 to 1073741823",
     [](const std::string& v, UdpEndpoint& e) { return assign(whole_number(v, 1, 1073741823), e.buffer); }},
    {"binary", For::write, switch_allowed,
     [](const std::string& v, UdpEndpoint& e) { return assign_switch(v, e.binary); }},
    {"ttl", For::write, "a whole number from 0 to 255",
     [](const std::string& v, UdpEndpoint& e) { return assign(whole_number(v, 0, 255), e.ttl); }},
    {"constants_period", For::write, "seconds from 0 to 86400",
     [](const std::string& v, UdpEndpoint& e) { return assign(real_number(v, 0.0, 86400.0), e.constants_period); }},
}};

constexpr std::array<Option<ShmEndpoint>, 3> shm_options{{
    {"layout", For::write, layout_allowed,
     [](const std::string& v, ShmEndpoint& e) { return assign_layout(v, e.layout); }},
    {"mode", For::write, "octal permissions from 0 to 0777",
     [](const std::string& v, ShmEndpoint& e) { return assign(whole_number(v, 0, 0777, 8), e.mode); }},
    {"recreate", For::write, switch_allowed,
     [](const std::string& v, ShmEndpoint& e) { return assign_switch(v, e.recreate); }},
}};

constexpr std::array<Option<FileEndpoint>, 7> file_options{{
    {"rate", For::read, "fields a second from 0.001 to 100000",
     [](const std::string& v, FileEndpoint& e) { return assign(real_number(v, 1e-3, 1e5), e.rate); }},
    {"speed", For::read, "0 (as fast as possible) and a factor from 0.001 to 1000",
     [](const std::string& v, FileEndpoint& e) {
       return assign(real_number(v, 0.0, 1e3), e.speed) && (e.speed == 0.0 || e.speed >= 1e-3);
     }},
    {"loop", For::read, switch_allowed, [](const std::string& v, FileEndpoint& e) { return assign_switch(v, e.loop); }},
    {"time", For::read, "timecode and now",
     [](const std::string& v, FileEndpoint& e) {
       e.time = v == "now" ? FileTime::now : FileTime::timecode;
       return v == "now" || v == "timecode";
     }},
    {"date", For::read, "a day of the calendar from 1970 on as YYYY-MM-DD",
     [](const std::string& v, FileEndpoint& e) { return assign_date(v, e.date); }},
    {"timecode", For::write, "HH:MM:SS:FF:D, D being 1 or 2",
     [](const std::string& v, FileEndpoint& e) { return parse_time_code(e.timecode = v).has_value(); }},
    {"overwrite", For::write, switch_allowed,
     [](const std::string& v, FileEndpoint& e) { return assign_switch(v, e.overwrite); }},
}};

constexpr std::array<Option<MemoryEndpoint>, 0> memory_options{};

constexpr const char* word(Direction direction) { return direction == Direction::read ? "reading" : "writing"; }

template <typename Options>
std::string known_keys(const Options& options, Direction direction) {
  std::string keys;
  for (const auto& option : options) {
    if (!is_for(option.use, direction)) continue;
    if (!keys.empty()) keys += ", ";
    keys += option.key;
  }
  return keys.empty() ? "none" : keys;
}

template <typename E, std::size_t N>
tl::expected<void, std::string> set_options(const Url& url, Direction direction, const std::array<Option<E>, N>& known,
                                            E& endpoint) {
  for (const UrlOption& given : url.options) {
    const Option<E>* option = nullptr;
    for (const auto& candidate : known) {
      if (candidate.key == given.key) option = &candidate;
    }
    const std::string allowed_here =
        std::string(word(direction)) + " " + url.scheme + " knows " + known_keys(known, direction);
    if (option == nullptr) return tl::make_unexpected("unknown option " + given.key + ": " + allowed_here);
    if (!is_for(option->use, direction)) {
      const Direction other = direction == Direction::read ? Direction::write : Direction::read;
      return tl::make_unexpected("option " + given.key + " is for " + word(other) + ": " + allowed_here);
    }
    const auto value = percent_decoded(given.value);
    if (!value) return tl::make_unexpected("option " + given.key + " = " + value.error());
    if (!option->set(*value, endpoint)) {
      return tl::make_unexpected("option " + given.key + " = \"" + *value + "\": allowed are " +
                                 std::string(option->allowed));
    }
  }
  return {};
}

struct HostAndPort {
  std::string_view host, port;
  bool has_port = false;
};

tl::expected<HostAndPort, std::string> split_host(std::string_view place) {
  const bool bracketed = !place.empty() && place.front() == '[';
  const std::size_t host_end = bracketed ? place.find(']') : std::min(place.find(':'), place.size());
  if (host_end == std::string_view::npos) {
    return tl::make_unexpected("host \"" + std::string(place) + "\" has a [ without ]");
  }
  HostAndPort parts;
  parts.host = bracketed ? place.substr(1, host_end - 1) : place.substr(0, host_end);
  const std::string_view rest = place.substr(bracketed ? host_end + 1 : host_end);
  parts.has_port = !rest.empty() && rest.front() == ':';
  if (parts.has_port) parts.port = rest.substr(1);
  if (parts.port.find(':') != std::string_view::npos) {
    return tl::make_unexpected("host \"" + std::string(place) + "\": an IPv6 address stands in [ ], as in [::1]:7000");
  }
  const std::string_view beyond = parts.has_port ? std::string_view{} : rest;
  if (parts.host.find_first_of("/ []") != std::string_view::npos || !beyond.empty()) {
    return tl::make_unexpected("host \"" + std::string(place) +
                               "\": a name, an IPv4 address or [an IPv6 address] and " +
                               "nothing behind the port is allowed");
  }
  return parts;
}

Result udp_from(const Url& url, Direction direction) {
  if (url.place.compare(0, 2, "//") != 0) {
    return tl::make_unexpected("\"" + url.place + "\": udp://HOST:PORT is allowed");
  }
  const auto place = split_host(std::string_view(url.place).substr(2));
  if (!place) return tl::make_unexpected(place.error());
  UdpEndpoint endpoint;
  const auto host = percent_decoded(place->host);
  if (!host) return tl::make_unexpected("host = " + host.error());
  endpoint.host = *host;
  if (endpoint.host.empty() && direction == Direction::write) {
    return tl::make_unexpected(std::string("no host: writing needs the one to send to, as in udp://192.0.2.7:7000"));
  }
  if (!place->has_port) {
    return tl::make_unexpected(std::string("no port: there is no standard one, so it must be given (udp://HOST:PORT)"));
  }
  const int lowest_port = direction == Direction::read ? 0 : 1;
  const auto port = whole_number(place->port, lowest_port, 65535);
  if (!port) {
    return tl::make_unexpected("port = \"" + std::string(place->port) + "\": allowed for " + word(direction) +
                               " is a whole number from " + std::to_string(lowest_port) + " to 65535");
  }
  endpoint.port = static_cast<std::uint16_t>(*port);
  const auto set = set_options(url, direction, udp_options, endpoint);
  if (!set) return tl::make_unexpected(set.error());
  const auto& layout = endpoint.layout;
  if (direction == Direction::write && layout.generation.has_value() && !endpoint.binary) {
    return tl::make_unexpected(std::string("option layout counts for binary records only: give binary=1, too"));
  }
  return endpoint;
}

Result shm_from(const Url& url, Direction direction) {
  ShmEndpoint endpoint;
  if (!assign(whole_number(url.place, 0, 61), endpoint.slot)) {
    return tl::make_unexpected("slot = \"" + url.place + "\": allowed is a whole number from 0 to 61");
  }
  const auto set = set_options(url, direction, shm_options, endpoint);
  if (!set) return tl::make_unexpected(set.error());
  return endpoint;
}

Result file_from(const Url& url, Direction direction) {
  std::string_view place = url.place;
  if (place.substr(0, 2) == "//") {
    place.remove_prefix(2);
    if (place.empty() || place.front() != '/') {
      return tl::make_unexpected("\"" + url.place + "\": file:PATH and file:///PATH are allowed, a host is not");
    }
  }
  const auto path = percent_decoded(place);
  if (!path) return tl::make_unexpected("path = " + path.error());
  if (path->empty()) return tl::make_unexpected(std::string("no path: file:PATH is allowed"));
  FileEndpoint endpoint;
  endpoint.path = *path;
  const auto set = set_options(url, direction, file_options, endpoint);
  if (!set) return tl::make_unexpected(set.error());
  return endpoint;
}

Result memory_from(const Url& url, Direction direction) {
  const auto name = percent_decoded(url.place);
  if (!name) return tl::make_unexpected("name = " + name.error());
  if (name->empty()) return tl::make_unexpected(std::string("no name: memory:NAME is allowed"));
  MemoryEndpoint endpoint{*name};
  const auto set = set_options(url, direction, memory_options, endpoint);
  if (!set) return tl::make_unexpected(set.error());
  return endpoint;
}

Result endpoint_from(const Url& url, Direction direction) {
  if (url.scheme == "udp") return udp_from(url, direction);
  if (url.scheme == "shm") return shm_from(url, direction);
  if (url.scheme == "file") return file_from(url, direction);
  if (url.scheme == "memory") return memory_from(url, direction);
  return tl::make_unexpected("scheme \"" + url.scheme + "\": allowed are udp, shm and file");
}

}  // namespace

tl::expected<Endpoint, std::string> parse_endpoint(std::string_view text, Direction direction) {
  const auto url = split_url(text);
  auto endpoint = url ? endpoint_from(*url, direction) : Result(tl::make_unexpected(url.error()));
  if (!endpoint) return tl::make_unexpected("endpoint \"" + std::string(text) + "\": " + endpoint.error());
  return endpoint;
}

}  // namespace trk_bridge::transport
