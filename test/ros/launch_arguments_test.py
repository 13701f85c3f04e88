#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Known and unknown arguments of this package's launch files."""

import pathlib
import subprocess
import unittest

LAUNCH = pathlib.Path(__file__).resolve().parents[2] / "launch"


def launched(*words):
    """--nodes reads the files like a start, but starts nothing."""
    return subprocess.run(["roslaunch", "--nodes", *words], capture_output=True, text=True, check=False)


class LaunchArguments(unittest.TestCase):
    def assert_refused(self, result, *texts):
        self.assertNotEqual(result.returncode, 0, result.stdout)
        for text in texts:
            self.assertIn(text, result.stdout + result.stderr)

    def test_known_arguments_are_taken(self):
        for words in (("trk_to_ros.launch", "source:=udp://:7000", "camera:=crane1", "required:=true"),
                      ("trk_to_ros_nodelet.launch", "source:=udp://:7000", "distortion:=plumb_bob"),
                      ("ros_to_trk.launch", "sinks:=udp://127.0.0.1:7000", "respawn:=true"),
                      ("trk_to_ros_cameras.launch",), ("record.launch",), ("delay_meter.launch",),
                      ("playback.launch", "file:=take.trk"), ("crane.launch", "rviz:=false")):
            result = launched("trk_bridge", *words)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn("/", result.stdout)

    def test_unknown_arguments_are_refused_with_the_nearest(self):
        self.assert_refused(launched("trk_bridge", "trk_to_ros.launch", "source:=udp://:7000", "camra:=crane1"),
                            "trk_to_ros.launch has no argument camra; the nearest is camera")
        self.assert_refused(launched(str(LAUNCH / "ros_to_trk.launch"), "sinks:=udp://127.0.0.1:7000", "pressets:=orad"),
                            "no argument pressets; the nearest is preset")
        self.assert_refused(launched("trk_bridge", "trk_to_ros_nodelet.launch", "source:=udp://:7000", "markers:=true"),
                            "has no argument markers")

    def test_every_launch_file_checks_its_own(self):
        for path in LAUNCH.glob("*.launch"):
            self.assert_refused(launched(str(path), "source:=udp://:7000", "sinks:=udp://127.0.0.1:7000", "file:=t.trk",
                                         "nonsense:=1"),
                                f"{path.name} has no argument nonsense")


if __name__ == "__main__":
    unittest.main()
