// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What is wrong with an endpoint's URL.
#pragma once

#include <string>

#include "trk_bridge/endpoints/endpoints.h"

namespace trk_bridge::test {

/// Why the URL is not valid for a source; "no error" if it is.
inline std::string read_error(const std::string& url) {
  const auto endpoint = endpoints::parse_source(url);
  return endpoint ? "no error" : endpoint.error();
}

/// Why the URL is not valid for a sink; "no error" if it is.
inline std::string write_error(const std::string& url) {
  const auto endpoint = endpoints::parse_sink(url);
  return endpoint ? "no error" : endpoint.error();
}

}  // namespace trk_bridge::test
