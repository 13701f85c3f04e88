// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "mains.h"

int main(int argc, char** argv) { return trk_bridge::nodes::ros_to_trk_main(argc, argv); }
