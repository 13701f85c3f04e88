// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_net.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>

#include "environment.h"
#include "handles.h"
#include "params_ring.h"
#include "records.h"
#include "transport/receive_socket.h"
#include "transport/socket.h"
#include "trk/datagram_decoder.h"
#include "trk/udp.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::c_api {
namespace {

// A call ends even if datagrams arrive faster than it reads them. No receive buffer holds this many.
constexpr int most_datagrams = 32768;

bool is_port(int port) noexcept { return port >= 1 && port <= std::numeric_limits<std::uint16_t>::max(); }

/// One receiving port and what arrived there. It uses the socket directly, because it does not need the features of
/// transport::Source.
class NetReader {
 public:
  NetReader(std::unique_ptr<transport::ReceiveSocket> socket, bool skips_old)
      : socket_(std::move(socket)), skips_old_(skips_old) {}

  trkError read(trkCameraParams& into) {
    const bool works = drain();
    return give(works, skips_old_ ? ring_.pop_newest() : ring_.pop_oldest(), into);
  }

  trkError read_paced(trkCameraParams& into, unsigned passed, unsigned tolerated) {
    const bool works = drain();
    return give(works, ring_.pop_paced(passed, tolerated), into);
  }

  trkError read(trkCameraConstants& into) {
    const bool works = drain();
    const trkError given = give(works, has_new_constants_ ? constants_ : std::nullopt, into);
    has_new_constants_ = false;
    return given;
  }

  /// The last ones, new or not.
  trkError read_again(trkCameraConstants& into) {
    const bool works = drain();
    has_new_constants_ = false;
    return give(works, constants_, into);
  }

  int queued() {
    drain();
    return static_cast<int>(ring_.size());
  }

  void skip_old(bool skips) noexcept { skips_old_ = skips; }

 private:
  /// False when the port can no longer be read.
  bool drain() {
    for (int i = 0; i < most_datagrams; ++i) {
      int error = 0;
      const auto datagram = socket_->next(/*waits=*/false, error);
      if (!datagram) return !transport::is_permanent(error);
      if (datagram->was_longer) {
        malformed_ = true;
      } else {
        decoder_.begin(datagram->bytes, datagram->sender);
        take_samples();
      }
      // This was all that had arrived when the call began. Another read would double the system calls.
      if (!socket_->has_more()) return true;
    }
    return true;
  }

  void take_samples() {
    for (;;) {
      switch (decoder_.next(sample_, fault_)) {
        case transport::Decoder::Next::sample:
          if (const auto* params = std::get_if<wire::CameraParams>(&sample_.record)) {
            ring_.push(*params);
          } else {
            constants_ = std::get<wire::CameraConstants>(sample_.record);
            has_new_constants_ = true;
          }
          break;
        case transport::Decoder::Next::fault:
          malformed_ = true;
          break;
        case transport::Decoder::Next::none:
          return;
      }
    }
  }

  template <typename Record, typename CRecord>
  trkError give(bool works, const std::optional<Record>& record, CRecord& into) {
    if (record) {
      into = to_c(*record);
      return trkOK;
    }
    if (!works) return trkFailed;
    return std::exchange(malformed_, false) ? trkInvalidVersion : trkUnavailable;
  }

  std::unique_ptr<transport::ReceiveSocket> socket_;
  trk::DatagramDecoder decoder_{wire::LayoutChoice{}};
  transport::Sample sample_;
  transport::Fault fault_;
  ParamsRing ring_;
  std::optional<wire::CameraConstants> constants_;
  bool has_new_constants_ = false;
  bool malformed_ = false;
  bool skips_old_;
};

using NetWriter = std::unique_ptr<transport::Sink>;

/// Calls `read(reader)` with the port of the handle.
template <typename Read>
trkError receive(trkHandle handle, bool valid_arguments, Read&& read) {
  return guarded([&] {
    return handles<NetReader>().with(handle,
                                     [&](NetReader& reader) { return valid_arguments ? read(reader) : trkFailed; });
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

trkError open_reader(int port, bool skips_old, trkHandle* handle) {
  return guarded([&] {
    if (handle == nullptr || !is_port(port)) return trkFailed;
    transport::ReceiveSettings settings;
    settings.port = static_cast<std::uint16_t>(port);
    settings.has_arrivals = false;
    *handle = handles<NetReader>().open(std::make_unique<transport::ReceiveSocket>(settings), skips_old);
    return trkOK;
  });
}

/// Reads MULTICAST_TTL from the environment; false if it is not a TTL.
bool set_ttl(std::optional<int>& ttl) {
  const char* const text = std::getenv("MULTICAST_TTL");
  if (text == nullptr) return true;
  ttl = transport::whole_number(text, 0, 255);
  if (!ttl) std::fprintf(stderr, "libtrk: MULTICAST_TTL=%s: allowed are whole numbers from 0 to 255\n", text);
  return ttl.has_value();
}

}  // namespace
}  // namespace trk_bridge::c_api

using namespace trk_bridge;
using c_api::guarded;
using c_api::handles;
using c_api::NetReader;
using c_api::NetWriter;

#ifdef TRK_IDENTIFIED

trkError trkNetOpenRead(int localPort, trkHandle* handle, int skipOld) {
  return c_api::open_reader(localPort, skipOld != 0, handle);
}

trkError trkNetReadConstants2(trkHandle handle, trkCameraConstants* constants) {
  return c_api::receive(handle, constants != nullptr, [&](NetReader& reader) { return reader.read_again(*constants); });
}

int trkNetParamsAvailable(trkHandle handle) {
  int queued = 0;
  c_api::receive(handle, true, [&](NetReader& reader) {
    queued = reader.queued();
    return trkOK;
  });
  return queued;
}

void trkNetSkipOld(int skip, trkHandle handle) {
  c_api::receive(handle, true, [&](NetReader& reader) {
    reader.skip_old(skip != 0);
    return trkOK;
  });
}

#else

trkError trkNetOpenRead(int localPort, trkHandle* handle) { return c_api::open_reader(localPort, true, handle); }

#endif

trkError trkNetOpenWrite(const char* remoteHost, int remotePort, int binary, trkHandle* handle) {
  return guarded([&] {
    if (remoteHost == nullptr || *remoteHost == '\0' || handle == nullptr || !c_api::is_port(remotePort)) {
      return trkFailed;
    }
    trk::UdpSinkSettings settings;
    settings.host = remoteHost;
    settings.port = static_cast<std::uint16_t>(remotePort);
    settings.binary = binary != 0;
    if (settings.binary) {
      const auto layout = c_api::layout_from_environment();
      if (!layout) return trkFailed;
      settings.layout = *layout;
    }
    const bool to_group = transport::is_multicast(transport::resolve(settings.host, settings.port).front());
    if (to_group && !c_api::set_ttl(settings.ttl)) return trkFailed;
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
  const bool valid = params != nullptr && numPassed >= 0 && numTolerated >= 0;
  return c_api::receive(handle, valid, [&](NetReader& reader) {
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
