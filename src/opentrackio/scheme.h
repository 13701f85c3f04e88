// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The scheme opentrackio: OpenTrackIO over UDP.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "packet.h"
#include "records.h"
#include "transport/datagram.h"
#include "transport/scheme.h"

namespace trk_bridge::opentrackio {

inline constexpr std::uint16_t standard_port = 55555;

/// `opentrackio://[host][:port]?source=…&tai_offset=…` and the options of every datagram source, to read from.
struct SourceSettings : transport::ReceiveSettings {
  /// Source number whose groups are joined: that of version 1.0.1 (239.135.1.N) and that of 1.0.0 (235.135.1.N). Used
  /// if the host is one of them or is not given. 0: none.
  std::uint32_t source = 0;
  bool takes_any = false;  ///< `source=any`: accepts samples with an invalid source number
  int tai_offset = 37;     ///< s

  /// The one or two addresses to listen on.
  std::vector<transport::ReceiveSettings> places() const;
};

/// `opentrackio://[host][:port]?source=…&encoding=…&profile=…&distortion=…&rate=…&tai_offset=…&source_id=…` and the
/// options of every datagram sink, to write to.
struct SinkSettings : transport::SendSettings {
  WriterSettings writer;
  Encoding encoding = Encoding::json;
  std::string source_id;  ///< urn:uuid:…
};

/// Errors name the part of the URL, its value and what is allowed.
tl::expected<SourceSettings, std::string> source_settings(const transport::Url&);
tl::expected<SinkSettings, std::string> sink_settings(const transport::Url&);

extern const transport::Scheme scheme;

}  // namespace trk_bridge::opentrackio
