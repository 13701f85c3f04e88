#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Reads a bag of trk with rosbag's Python library: read_by_python.py TRK TAKE."""
import os
import subprocess
import sys
import tempfile

import rosbag


def main(trk, take):
    with tempfile.TemporaryDirectory() as directory:
        for compression in ("none", "bz2", "lz4"):
            path = os.path.join(directory, compression + ".bag")
            subprocess.run([trk, "bag", take, path, "--camera", "crane1", "--compression", compression], check=True)
            with rosbag.Bag(path) as bag:
                check(bag, fields_in(take))


def fields_in(take):
    with open(take) as lines:
        text = [line for line in lines if line.strip() and not line.startswith("#")]
    return [line.split() for line in text[3:]]


def check(bag, fields):
    info = bag.get_type_and_topic_info()
    counts = {topic: found.message_count for topic, found in info.topics.items()}
    assert counts == {"/crane1/params": len(fields), "/crane1/constants": 1, "/crane1/camera_info": len(fields),
                      "/crane1/time_code": len(fields), "/tf": len(fields), "/tf_static": 1}, counts
    seen = 0
    codes = []
    for topic, message, time in bag.read_messages():
        if topic == "/crane1/params":
            assert message.header.stamp == time
            assert message.x == float(fields[seen][1]), (seen, message.x)
            assert message.counter == int(fields[seen][-1]), (seen, message.counter)
            seen += 1
        elif topic == "/crane1/time_code":
            codes = codes or [message]
        elif topic == "/tf_static":
            assert message.transforms[0].child_frame_id == "crane1_optical"
    assert seen == len(fields)
    first = codes[0]
    code = [first.hours, first.minutes, first.seconds, first.frames, first.field, first.drop_frame, first.rate]
    assert code == [3, 13, 51, 0, 1, False, 50], code


if __name__ == "__main__":
    main(*sys.argv[1:])
