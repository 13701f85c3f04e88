// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "nodes/node.h"
#include "test_card.h"

int main(int argc, char** argv) {
  return trk_bridge::nodes::node_main<trk_bridge::demo::TestCard>(argc, argv, "test_card");
}
