#!/usr/bin/env python3
"""A ROS master on a port that the kernel picks, or on the one given. Prints its URI, and runs until it is killed."""

import signal
import sys

from rosmaster.master import Master

master = Master(int(sys.argv[1]) if len(sys.argv) > 1 else 0)
master.start()
print(master.uri, flush=True)
while True:
    signal.pause()
