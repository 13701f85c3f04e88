#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""A ROS master on a port that the kernel picks. Prints its URI, and runs until it is killed."""

import signal

from rosmaster.master import Master

master = Master(0)
master.start()
print(master.uri, flush=True)
while True:
    signal.pause()
