// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <trk_bridge/endpoints/endpoints.h>
#include <trk_bridge/transport/source.h>

// Knows the schemes, and reports what is wrong with a URL of an unknown one.
int main() {
  const auto good = trk_bridge::endpoints::parse_source("udp://127.0.0.1:3000");
  const auto bad = trk_bridge::endpoints::parse_source("carrier_pigeon://127.0.0.1:3000");
  return good && !bad && bad.error().find("carrier_pigeon") != std::string::npos ? 0 : 1;
}
