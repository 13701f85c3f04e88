// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The scheme shm: trk in shared memory.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "transport/scheme.h"
#include "trk_bridge/wire/layout.h"

namespace trk_bridge::shm {

/// `shm:SLOT?layout=…&mode=…&recreate=1`, slots 0 to 61. The options are for writing.
struct Settings {
  int slot = 0;
  wire::LayoutChoice layout;  ///< of a segment that is created; default_layout for what is not given
  int mode = 0666;            ///< permissions of a segment that is created, up to 0777
  bool recreate = false;      ///< trkMemRecreate of the document
};

/// Errors name the part of the URL, its value and what is allowed.
tl::expected<Settings, std::string> source_settings(const transport::Url&);
tl::expected<Settings, std::string> sink_settings(const transport::Url&);

/// Throw TransportError. A slot without a segment is not an error for reading.
std::unique_ptr<transport::Source> open_source(const Settings&);
std::unique_ptr<transport::Sink> open_sink(const Settings&);

extern const transport::Scheme scheme;

}  // namespace trk_bridge::shm
