// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// main() of the programs of nodes. It is in the library of the node, where the headers of roscpp are compiled anyway.
#pragma once

namespace trk_bridge::nodes {

int trk_to_ros_main(int argc, char** argv);
int ros_to_trk_main(int argc, char** argv);
int delay_meter_main(int argc, char** argv);

}  // namespace trk_bridge::nodes
