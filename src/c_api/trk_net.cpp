#include <trk/trk_net.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "handles.h"
#include "params_ring.h"
#include "records.h"
#include "trk/udp.h"

namespace trk_bridge::c_api {
namespace {

using transport::Event;

// A call ends even when datagrams come faster than it reads them.
constexpr int most_datagrams = 4096;

bool is_port(int port) noexcept { return port >= 1 && port <= std::numeric_limits<std::uint16_t>::max(); }

/// One receiving port and what arrived there.
class NetReader {
 public:
  explicit NetReader(std::unique_ptr<transport::Source> source) : source_(std::move(source)) {}

  trkError read(trkCameraParams& into) {
    const bool works = drain();
    return give(works, ring_.pop_newest(), into);
  }

  trkError read_paced(trkCameraParams& into, unsigned passed, unsigned tolerated) {
    const bool works = drain();
    return give(works, ring_.pop_paced(passed, tolerated), into);
  }

  trkError read(trkCameraConstants& into) {
    const bool works = drain();
    const trkError given = give(works, constants_, into);
    constants_.reset();
    return given;
  }

 private:
  /// False when the port can no longer be read.
  bool drain() {
    for (int i = 0; i < most_datagrams; ++i) {
      switch (source_->receive(reception_, std::chrono::nanoseconds::zero())) {
        case Event::sample:
          if (const auto* params = std::get_if<wire::CameraParams>(&reception_.sample.record)) {
            ring_.push(*params);
          } else {
            constants_ = std::get<wire::CameraConstants>(reception_.sample.record);
          }
          break;
        case Event::malformed:
          unsound_ = true;
          break;
        case Event::idle:
          return true;
        case Event::stopped:
        case Event::ended:
        case Event::failed:
          return false;
      }
    }
    return true;
  }

  template <typename Record, typename CRecord>
  trkError give(bool works, const std::optional<Record>& record, CRecord& into) {
    if (record) {
      into = to_c(*record);
      return trkOK;
    }
    if (!works) return trkFailed;
    return std::exchange(unsound_, false) ? trkInvalidVersion : trkUnavailable;
  }

  std::unique_ptr<transport::Source> source_;
  transport::Reception reception_;
  ParamsRing ring_;
  std::optional<wire::CameraConstants> constants_;
  bool unsound_ = false;
};

using NetWriter = std::unique_ptr<transport::Sink>;

/// `read(reader)` with the handle's port.
template <typename Read>
trkError receive(trkHandle handle, bool sound_arguments, Read&& read) {
  return guarded([&] {
    return handles<NetReader>().with(handle,
                                     [&](NetReader& reader) { return sound_arguments ? read(reader) : trkFailed; });
  });
}

template <typename CRecord>
trkError send(trkHandle handle, const CRecord* record) {
  return guarded([&] {
    return handles<NetWriter>().with(handle, [&](NetWriter& sink) {
      if (!is_writable(record)) return trkFailed;
      return sink->write(from_c(*record)) ? trkOK : trkFailed;
    });
  });
}

}  // namespace
}  // namespace trk_bridge::c_api

using namespace trk_bridge;
using c_api::guarded;
using c_api::handles;
using c_api::NetReader;
using c_api::NetWriter;

trkError trkNetOpenRead(int localPort, trkHandle* handle) {
  return guarded([&] {
    if (handle == nullptr || !c_api::is_port(localPort)) return trkFailed;
    trk::UdpSourceSettings settings;
    settings.port = static_cast<std::uint16_t>(localPort);
    *handle = handles<NetReader>().open(trk::open_udp_source(settings));
    return trkOK;
  });
}

trkError trkNetOpenWrite(const char* remoteHost, int remotePort, int binary, trkHandle* handle) {
  return guarded([&] {
    if (remoteHost == nullptr || *remoteHost == '\0' || handle == nullptr || !c_api::is_port(remotePort)) {
      return trkFailed;
    }
    trk::UdpSinkSettings settings;
    settings.host = remoteHost;
    settings.port = static_cast<std::uint16_t>(remotePort);
    settings.binary = binary != 0;
    settings.layout.generation = wire::Generation::document;
    *handle = handles<NetWriter>().open(trk::open_udp_sink(settings));
    return trkOK;
  });
}

trkError trkNetClose(trkHandle handle) {
  return guarded([&] {
    const trkError closed = handles<NetReader>().close(handle, [](NetReader&) { return trkOK; });
    if (closed != trkInvalidHandle) return closed;
    return handles<NetWriter>().close(handle, [](NetWriter& sink) { return sink->close() ? trkOK : trkFailed; });
  });
}

trkError trkNetReadParams(trkHandle handle, trkCameraParams* params) {
  return c_api::receive(handle, params != nullptr, [&](NetReader& reader) { return reader.read(*params); });
}

trkError trkNetBufReadParams(trkHandle handle, trkCameraParams* params, int numPassed, int numTolerated) {
  const bool sound = params != nullptr && numPassed >= 0 && numTolerated >= 0;
  return c_api::receive(handle, sound, [&](NetReader& reader) {
    return reader.read_paced(*params, static_cast<unsigned>(numPassed), static_cast<unsigned>(numTolerated));
  });
}

trkError trkNetReadConstants(trkHandle handle, trkCameraConstants* constants) {
  return c_api::receive(handle, constants != nullptr, [&](NetReader& reader) { return reader.read(*constants); });
}

trkError trkNetWriteParams(trkHandle handle, const trkCameraParams* params) { return c_api::send(handle, params); }

trkError trkNetWriteConstants(trkHandle handle, const trkCameraConstants* constants) {
  return c_api::send(handle, constants);
}
