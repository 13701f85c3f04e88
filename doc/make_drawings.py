#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Draws every picture of doc/images that is a drawing or a plot, from the equations of doc/conventions.md and the
tables that doc/lens_fit.cpp, doc/stamp_figures.py and scripts/bench measure.

Usage: make_drawings.py [--check]. Without an argument the pictures are written; with --check none is, and those that are
not what would be written are an error. Needs nothing but Python.
"""

import pathlib
import sys

from drawings import lens_plot, modules, picture_plane, speed_plot, stamp_plot, studio

IMAGES = pathlib.Path(__file__).resolve().parent / "images"
PICTURES = {
    "frames.svg": studio.frames,
    "signs.svg": studio.signs,
    "y_up.svg": studio.y_up,
    "chip.svg": picture_plane.chip,
    "field_of_view.svg": picture_plane.field_of_view,
    "distortion.svg": picture_plane.distortion,
    "lens_fit_there.svg": lens_plot.there,
    "lens_fit_back.svg": lens_plot.back,
    "modules.svg": modules.modules,
    "stamps.svg": stamp_plot.stamps,
    "speed.svg": speed_plot.speed,
}


def main(arguments):
    if arguments not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    stale = []
    for name, draw in PICTURES.items():
        svg = draw().svg()
        path = IMAGES / name
        if not arguments:
            path.write_text(svg, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != svg:
            stale.append(name)
    for name in stale:
        print(f"{IMAGES / name} is not what make_drawings.py draws", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
