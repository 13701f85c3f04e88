// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "delay_meter.h"
#include "node.h"

int main(int argc, char** argv) {
  return trk_bridge::nodes::node_main<trk_bridge::nodes::DelayMeter>(argc, argv, "delay_meter");
}
