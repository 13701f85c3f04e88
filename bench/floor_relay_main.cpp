// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// floor_relay in|out _port:=PORT: see floor_relay.h.
#include <cstdio>
#include <string_view>

#include "floor_relay.h"
#include "nodes/node.h"

int main(int argc, char** argv) {
  using namespace trk_bridge;
  const std::string_view direction = argc > 1 ? argv[1] : "";
  if (direction != "in" && direction != "out") {
    std::fprintf(stderr, "usage: %s in|out _port:=PORT\n", argv[0]);
    return 2;
  }
  // The arguments of the node begin with the next one.
  argv[1] = argv[0];
  return direction == "in" ? nodes::node_main<bench::FloorIn>(argc - 1, argv + 1, "floor_relay")
                           : nodes::node_main<bench::FloorOut>(argc - 1, argv + 1, "floor_relay");
}
