// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "node.h"
#include "ros_to_trk.h"

int main(int argc, char** argv) {
  return trk_bridge::nodes::node_main<trk_bridge::nodes::RosToTrk>(argc, argv, "ros_to_trk");
}
