// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "mains.h"

int main(int argc, char** argv) { return trk_bridge::demo::crane_shot_main(argc, argv); }
