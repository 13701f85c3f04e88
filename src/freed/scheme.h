// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The scheme freed: Free-D D1 over UDP (doc/free_d.md).
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "decoder.h"
#include "encoder.h"
#include "transport/datagram.h"
#include "transport/scheme.h"

namespace trk_bridge::freed {

/// `freed://[host]:port?profile=…&lens=FILE.yaml&checksum=…` and the options of every UDP source, to read from.
struct SourceSettings : transport::ReceiveSettings, DecoderOptions {
  std::string lens;  ///< path of the table; empty: none
};

/// `freed://host:port?profile=…&lens=FILE.yaml&unwrap=0` and the options of every UDP sink, to write to. `lens` is
/// required if the profile has counts; with `lens=none`, zoom and focus are 0.
struct SinkSettings : transport::SendSettings, EncoderOptions {
  std::string lens;  ///< path of the table, or none
};

/// These load the lens table. Errors name the part of the URL, its value and what is allowed.
tl::expected<SourceSettings, std::string> source_settings(const transport::Url&);
tl::expected<SinkSettings, std::string> sink_settings(const transport::Url&);

extern const transport::Scheme scheme;

}  // namespace trk_bridge::freed
