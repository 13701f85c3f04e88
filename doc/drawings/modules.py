# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""The modules in layers: each box names the modules of lower layers that it uses directly."""

import textwrap

from .module_table import MODULES, arrows, level_of
from .svg import GREY, INK, Picture

SIZE = (190, 78)
USES_WIDTH = 30  # characters
GAP = (14, 22)
MARGIN = 20
LEGEND = 24


def modules():
    levels = {}
    for module in MODULES:
        levels.setdefault(level_of(module), []).append(module)
    widest = max(len(row) for row in levels.values())
    width = 2 * MARGIN + widest * SIZE[0] + (widest - 1) * GAP[0]
    height = 2 * MARGIN + len(levels) * (SIZE[1] + GAP[1]) - GAP[1] + LEGEND
    picture = Picture(width, height, "The modules and their dependencies")
    for level, row in levels.items():
        top = MARGIN + (len(levels) - 1 - level) * (SIZE[1] + GAP[1])
        row_width = len(row) * SIZE[0] + (len(row) - 1) * GAP[0]
        for place, module in enumerate(row):
            _box(picture, module, (width - row_width) / 2 + place * (SIZE[0] + GAP[0]), top)
    picture.text((MARGIN, height - MARGIN + 8), "dashed: needs ROS; indirect dependencies are not shown", 12, GREY)
    return picture


def _box(picture, module, left, top):
    ros = MODULES[module].ros
    picture.rectangle(left, top, *SIZE, fill="#ffffff" if ros else "#eaf2fb", stroke="#1565c0", dash="6 4" if ros else "")
    middle = left + SIZE[0] / 2
    picture.text((middle, top + 20), module, 14, INK, "middle", bold=True)
    picture.text((middle, top + 38), MODULES[module].what, 11, GREY, "middle")
    used = [below for user, below in arrows() if user == module]
    if used:
        for line, text in enumerate(textwrap.wrap("uses " + ", ".join(used), USES_WIDTH)):
            picture.text((middle, top + 55 + 15 * line), text, 11, "#1565c0", "middle")
