// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "node.h"
#include "trk_to_ros.h"

int main(int argc, char** argv) {
  return trk_bridge::nodes::node_main<trk_bridge::nodes::TrkToRos>(argc, argv, "trk_to_ros");
}
