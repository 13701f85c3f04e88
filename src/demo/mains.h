// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// main() of the programs of nodes. It is in the library of the node, where the headers of roscpp are compiled anyway.
#pragma once

namespace trk_bridge::demo {

int crane_shot_main(int argc, char** argv);
int test_card_main(int argc, char** argv);

}  // namespace trk_bridge::demo
