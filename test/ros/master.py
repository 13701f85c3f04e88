#!/usr/bin/env python3
"""A ROS master on a port that the kernel picks. Prints its URI, and runs until it is killed."""

import signal

from rosmaster.master import Master

master = Master(0)
master.start()
print(master.uri, flush=True)
while True:
    signal.pause()
