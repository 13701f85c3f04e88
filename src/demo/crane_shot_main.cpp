// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "crane_shot.h"
#include "nodes/node.h"

int main(int argc, char** argv) {
  return trk_bridge::nodes::node_main<trk_bridge::demo::CraneShot>(argc, argv, "crane_shot");
}
