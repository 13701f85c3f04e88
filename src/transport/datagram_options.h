// What the URLs of all protocols over UDP have in common: SCHEME://[HOST]:PORT and the options of sockets.
#pragma once

#include <array>
#include <string>

#include <tl/expected.hpp>

#include "datagram_sink.h"
#include "receive_socket.h"
#include "scheme.h"

namespace trk_bridge::transport {

extern const std::array<Option<ReceiveSettings>, 3> receive_options;
extern const std::array<Option<SendSettings>, 3> send_options;

/// Host and port of the URL. The port must be given.
tl::expected<void, std::string> set_place(const Url& url, ReceiveSettings& settings);
tl::expected<void, std::string> set_place(const Url& url, SendSettings& settings);

/// Equal for two that only one of them could bind.
std::string place_of(const ReceiveSettings& settings);

}  // namespace trk_bridge::transport
