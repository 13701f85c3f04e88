// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "mains.h"

int main(int argc, char** argv) { return trk_bridge::nodes::trk_to_ros_main(argc, argv); }
