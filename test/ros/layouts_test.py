#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Checks that the layouts for other programs use existing topics and fields."""

import json
import pathlib
import re
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARAMS = re.findall(r"^\s*\w+(?:\[\d*\])?\s+(\w+)\s*(?:#|$)", (ROOT / "msg" / "CameraParams.msg").read_text(), re.MULTILINE)


class Layouts(unittest.TestCase):
    def assert_fields(self, names, separator):
        self.assertGreater(len(names), 4)
        for name in names:
            topic, field = name.rsplit(separator, 1)
            self.assertEqual(topic, "/crane1/params")
            self.assertIn(field, PARAMS)

    def test_foxglove(self):
        layout = json.loads((ROOT / "config" / "foxglove_layout.json").read_text())
        panels = layout["configById"]
        shown = re.findall(r'"(?:first|second)": "([^"]+)"', json.dumps(layout["layout"]))
        self.assertEqual(sorted(shown), sorted(panels))
        self.assert_fields([path["value"] for panel in panels.values() for path in panel.get("paths", [])], ".")

    def test_plotjuggler(self):
        layout = xml.etree.ElementTree.parse(ROOT / "config" / "plotjuggler_layout.xml")
        self.assert_fields([curve.get("name") for curve in layout.iter("curve")], "/")


if __name__ == "__main__":
    unittest.main()
