#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""A ROS master on a port that the kernel picks, or on the one given. Prints its URI, and runs until it is killed."""

import signal
import sys

from rosmaster.master import Master

master = Master(int(sys.argv[1]) if len(sys.argv) > 1 else 0)
master.start()
print(master.uri, flush=True)
while True:
    signal.pause()
